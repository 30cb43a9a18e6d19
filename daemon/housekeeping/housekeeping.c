#include "daemon/housekeeping/housekeeping.h"

#include "common/bus/open.h"
#include "common/bus/refusals_text.h"
#include "common/bus/status_words.h"
#include "common/bus/troubles_text.h"
#include "common/program/log.h"

#include <signal.h>
#include <time.h>

static const int period_ms = 20;
static const int64_t announce_us = 1000000;
static const int64_t say_refused_us = 1000000;
static const int64_t patience_us = 3 * 1000000; /* before a wait in lockstep is worth a word */

static sigset_t housekeeping_signals(void)
{
    sigset_t signals;

    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    return signals;
}

void housekeeping_take_signals(void)
{
    sigset_t signals = housekeeping_signals();

    pthread_sigmask(SIG_BLOCK, &signals, NULL);
}

static void say_what_is_awaited(struct housekeeping *housekeeping)
{
    int64_t now = bus_monotonic_us();

    if (loop_waits(housekeeping->loop) != LOOP_WAITS_FOR_OBSERVATION) {
        housekeeping->waiting_since = 0;
        return;
    }
    if (!housekeeping->waiting_since)
        housekeeping->waiting_since = now;
    if (now - housekeeping->waiting_since > patience_us && now - housekeeping->said > patience_us) {
        log_warning("waiting for the marker (or END_EFFECTOR) that is due: is vision running?");
        housekeeping->said = now;
    }
}

static void say_fault(struct housekeeping *housekeeping)
{
    int8_t fault = housekeeping->status.fault;
    char text[128];

    if (fault == housekeeping->fault)
        return;
    housekeeping->fault = fault;
    status_fault_text(&housekeeping->status, text, sizeof text);
    if (fault == REACH_STATUS_T_FAULT_NONE)
        log_warning("the fault was reset");
    else
        log_error("fault: %s; the arm is held until 'reachctl reset-fault'", text);
}

/* At most a line a second, however many messages are refused. */
static void say_refusals(struct housekeeping *housekeeping)
{
    int64_t now = bus_monotonic_us();
    char text[512];

    if (housekeeping->status.bad_inputs == housekeeping->refused.bad_inputs ||
        (housekeeping->refused_said && now - housekeeping->refused_said < say_refused_us))
        return;
    refusals_text(&housekeeping->status, &housekeeping->refused, text, sizeof text);
    log_warning("refused: %s", text);
    housekeeping->refused = housekeeping->status;
    housekeeping->refused_said = now;
}

/* Each when it begins. */
static void say_troubles(struct housekeeping *housekeeping)
{
    char text[300];

    for (int kind = 0; kind < TROUBLES; kind++)
        if (!(housekeeping->troubles & 1 << kind) &&
            trouble_text(&housekeeping->status, kind, text, sizeof text))
            log_warning("%s", text);
    housekeeping->troubles = housekeeping->status.troubles;
}

static void tell_service_manager(struct housekeeping *housekeeping)
{
    while (mailbox_take(daemon_bus_reports(housekeeping->bus), &housekeeping->status)) {
        housekeeping->any_status = true;
        say_fault(housekeeping);
    }
    say_refusals(housekeeping);
    say_troubles(housekeeping);
    service_manager_tell(&housekeeping->service_manager, bus_monotonic_us(),
                         loop_ticks(housekeeping->loop),
                         loop_waits(housekeeping->loop) != LOOP_RUNS,
                         housekeeping->any_status ? &housekeeping->status : NULL);
}

static void read_configuration_again(struct housekeeping *housekeeping)
{
    notify_send("RELOADING=1");
    reload_configuration(housekeeping->reload, housekeeping->bus, housekeeping->loop);
    notify_send("READY=1");
}

/* Again and again, so that a log has it whenever it was begun. */
static void say_configuration(struct housekeeping *housekeeping)
{
    int64_t now = bus_monotonic_us();

    if (housekeeping->announced && now - housekeeping->announced < announce_us)
        return;
    housekeeping->announced = now;
    daemon_bus_send_config(housekeeping->bus, housekeeping->reload->accepted);
}

void housekeeping_run(struct housekeeping *housekeeping)
{
    const struct timespec period = {.tv_nsec = (long)period_ms * 1000000};
    sigset_t signals = housekeeping_signals();

    service_manager_begin(&housekeeping->service_manager);
    for (;;) {
        int signal = sigtimedwait(&signals, NULL, &period);
        if (signal == SIGINT || signal == SIGTERM)
            break;
        if (signal == SIGHUP)
            read_configuration_again(housekeeping);
        watchdog_say(housekeeping->watchdog);
        say_what_is_awaited(housekeeping);
        say_configuration(housekeeping);
        tell_service_manager(housekeeping);
    }
    service_manager_end();
}
