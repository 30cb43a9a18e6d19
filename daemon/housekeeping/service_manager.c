#include "daemon/housekeeping/service_manager.h"

#include "common/bus/status_words.h"

#include <stdio.h>

static const int64_t line_period = 1000000; /* us */

void service_manager_begin(struct service_manager *manager)
{
    *manager = (struct service_manager){.watchdog = notify_watchdog_open()};
    notify_send("READY=1\nSTATUS=waiting for the robot");
}

/* What of the model would be lost now. */
static void write_storing(const reach_status_t *status, char *words, size_t size)
{
    if (!status->storing)
        snprintf(words, size, "not stored");
    else
        snprintf(words, size, "%lld to be stored",
                 (long long)(status->model_samples - status->samples_stored));
}

/* The line on a status, for people. */
static void write_line(const reach_status_t *status, char *line, size_t size)
{
    char storing[40];

    write_storing(status, storing, sizeof storing);
    snprintf(line, size,
             "%s, %s (%s) %d of %d; %lld samples, %s, %d experts; worst tick %.0f us, %lld "
             "overruns; %lld messages refused, %lld samples dropped",
             status_state_word(status->state), status_behaviour_word(status->behaviour),
             status_phase_word(status->phase), status->progress, status->progress_total,
             (long long)status->samples, storing, status->experts, status->compute_max_us,
             (long long)status->overruns, (long long)status->bad_inputs,
             (long long)status->dropped_samples);
}

void service_manager_tell(struct service_manager *manager, int64_t now, int64_t ticks, bool waits,
                          const reach_status_t *status)
{
    char line[400];

    if (ticks != manager->ticks || waits)
        notify_watchdog_feed(&manager->watchdog, now);
    manager->ticks = ticks;
    if (!status || now - manager->told < line_period)
        return;
    manager->told = now;
    write_line(status, line, sizeof line);
    notify_send("STATUS=%s", line);
}

void service_manager_end(void)
{
    notify_send("STOPPING=1\nSTATUS=stopping the arm");
}
