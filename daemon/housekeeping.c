#include "daemon/housekeeping.h"

#include "common/bus/open.h"
#include "common/bus/status_words.h"
#include "common/program/log.h"

#include <signal.h>
#include <time.h>

static const int period_ms = 20;
static const int64_t announce_us = 1000000;
static const int64_t patience_us = 3 * 1000000; /* before a wait in lockstep is worth a word */

static sigset_t house_signals(void)
{
    sigset_t signals;

    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    return signals;
}

void house_take_signals(void)
{
    sigset_t signals = house_signals();

    pthread_sigmask(SIG_BLOCK, &signals, NULL);
}

static void say_what_is_awaited(struct house *house)
{
    int64_t now = bus_monotonic_us();

    if (loop_waits(house->loop) != LOOP_WAITS_FOR_OBSERVATION) {
        house->waiting_since = 0;
        return;
    }
    if (!house->waiting_since)
        house->waiting_since = now;
    if (now - house->waiting_since > patience_us && now - house->said > patience_us) {
        log_warning("waiting for the marker (or END_EFFECTOR) that is due: is vision running?");
        house->said = now;
    }
}

static void say_fault(struct house *house)
{
    int8_t fault = house->status.fault;

    if (fault == house->fault)
        return;
    house->fault = fault;
    if (fault == REACH_STATUS_T_FAULT_NONE)
        log_warning("the fault was reset");
    else
        log_error("fault: %s; the arm is held until 'reachctl reset-fault'",
                  status_fault_word(fault));
}

static void tell_service(struct house *house)
{
    while (mailbox_take(daemon_bus_reports(house->bus), &house->status)) {
        house->any_status = true;
        say_fault(house);
    }
    service_keep(&house->service, bus_monotonic_us(), loop_ticks(house->loop),
                 loop_waits(house->loop) != LOOP_RUNS, house->any_status ? &house->status : NULL);
}

static void read_configuration_again(struct house *house)
{
    notify_send("RELOADING=1");
    reload_configuration(house->reload, house->bus, house->loop);
    notify_send("READY=1");
}

/* Again and again, so that a log has it whenever it was begun. */
static void say_configuration(struct house *house)
{
    int64_t now = bus_monotonic_us();

    if (house->announced && now - house->announced < announce_us)
        return;
    house->announced = now;
    daemon_bus_send_config(house->bus, house->reload->accepted);
}

void house_keep(struct house *house)
{
    const struct timespec period = {.tv_nsec = (long)period_ms * 1000000};
    sigset_t signals = house_signals();

    service_begin(&house->service);
    for (;;) {
        int signal = sigtimedwait(&signals, NULL, &period);
        if (signal == SIGINT || signal == SIGTERM)
            break;
        if (signal == SIGHUP)
            read_configuration_again(house);
        say_what_is_awaited(house);
        say_configuration(house);
        tell_service(house);
    }
    service_end();
}
