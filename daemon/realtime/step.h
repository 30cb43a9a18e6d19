/* One step of the loop: take, decide, report. What both clocks do about a tick, between the
 * mailboxes of the bus and the watchdog. All of it is the loop thread's, but what is atomic. */
#ifndef REACH_DAEMON_REALTIME_STEP_H
#define REACH_DAEMON_REALTIME_STEP_H

#include "common/base/duration_histogram.h"
#include "daemon/bus/bus.h"
#include "daemon/config/config.h"
#include "daemon/control/tick.h"
#include "daemon/realtime/loop_wait.h"
#include "daemon/realtime/watchdog.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

struct step {
    const struct config *config;
    struct tick *tick;
    struct daemon_bus *bus;
    struct watchdog *watchdog;

    struct tick_inputs inputs;
    struct tick_outputs outputs;
    struct received_state received; /* newest state taken from the mailbox */
    bool any_state;
    int64_t newest_utime; /* lockstep: of the newest good one, us */

    struct duration_histogram compute, wakeup;
    int64_t overruns, slips, bad_states;
    int64_t page_faults; /* before the first tick */
    int overruns_in_a_row;

    _Atomic(const struct config *) offered;
    _Atomic bool ending;
    _Atomic int64_t ticks;
    _Atomic int waits;
};

/* Takes the requests that have come. */
void step_take_requests(struct step *step);

/* The tick's first call, and its command and sample on their way. */
void step_decide(struct step *step, int64_t now);

/* The tick's last call, and status and trace on their way. */
void step_report(struct step *step, int64_t now);

static inline void step_set_waits(struct step *step, enum loop_wait waits)
{
    atomic_store_explicit(&step->waits, (int)waits, memory_order_relaxed);
}

static inline bool step_ending(const struct step *step)
{
    return atomic_load_explicit(&step->ending, memory_order_relaxed);
}

#endif
