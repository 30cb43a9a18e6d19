#include "daemon/reload.h"

#include "common/program/log.h"
#include "daemon/config/load.h"
#include "daemon/config/table.h"

#include <stdio.h>
#include <string.h>

/* What may change; a name that ends in '.' stands for all that begin so. */
static const char *const live[] = {
    "eyes.stale",
    "motion.",
    "head.gain",
    "head.smoothing",
    "head.search_velocity",
    "fixation.",
    "babble.",
    "practice.",
    "explore.",
    "head.search_dwell",
    "task.gain",
    "task.smoothing",
    "task.follow_gain",
    "task.secondary_gain",
    "task.singular_threshold",
    "task.damping_max",
    "learner.quota",
};

static bool may_change(const char *name)
{
    for (size_t i = 0; i < sizeof live / sizeof live[0]; i++) {
        size_t length = strlen(live[i]);
        if (strncmp(name, live[i], length) == 0 &&
            (live[i][length - 1] == '.' || name[length] == '\0'))
            return true;
    }
    return false;
}

bool reload_allowed(const struct config *from, const struct config *to, int *changes, char *error,
                    size_t error_size)
{
    char before[OPTION_TEXT_SIZE], after[OPTION_TEXT_SIZE];

    *changes = 0;
    for (const struct option_row *row = config_table(); row->name; row++) {
        option_text(row, from, before);
        option_text(row, to, after);
        if (strcmp(before, after) == 0)
            continue;
        ++*changes;
        if (may_change(row->name))
            continue;
        snprintf(error, error_size,
                 "%s cannot change from %.60s to %.60s while the daemon runs; restart it",
                 row->name, before, after);
        return false;
    }
    return true;
}

/* A buffer that the loop neither works with nor is offered. */
static struct config *free_buffer(struct reload *reload, struct loop *loop)
{
    if (!reload->used)
        reload->used = reload->accepted;
    /* An offer that was not taken is taken back: the loop stands, and works with what it had. */
    if (!loop_offer_config(loop, NULL))
        reload->used = reload->accepted;
    return &reload->buffer[reload->used == &reload->buffer[0]];
}

void reload_configuration(struct reload *reload, struct daemon_bus *bus, struct loop *loop)
{
    struct config *taken;
    char error[512];
    int changes;

    if (config_load(&reload->read, reload->paths, reload->n_paths, reload->overrides,
                    reload->n_overrides, error, sizeof error) ||
        !reload_allowed(reload->accepted, &reload->read, &changes, error, sizeof error)) {
        log_error("the configuration stays as it is: %s", error);
        return;
    }
    log_info("the configuration was read again, %d options differ", changes);
    if (changes == 0)
        return;
    taken = free_buffer(reload, loop);
    *taken = reload->read;
    reload->accepted = taken;
    daemon_bus_send_config(bus, taken);
    loop_offer_config(loop, taken);
}
