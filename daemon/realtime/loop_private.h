/* The loop's state, for the files that make it up: loop.c (the thread, and what both clocks share),
 * clock_lockstep.c and clock_realtime.c (when a tick is). All of it is the loop thread's, but what
 * is atomic. */
#ifndef REACH_DAEMON_REALTIME_LOOP_PRIVATE_H
#define REACH_DAEMON_REALTIME_LOOP_PRIVATE_H

#include "common/base/durations.h"
#include "daemon/realtime/due_observations.h"
#include "daemon/realtime/loop.h"

#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>

struct loop {
    const struct config *config;
    struct tick *tick;
    struct daemon_bus *bus;
    struct watchdog *watchdog;
    bool lockstep;
    bool real_time;

    struct tick_inputs inputs;
    struct tick_outputs outputs;
    struct received_state received; /* newest state taken from the mailbox */
    bool any_state;
    struct due_observations due; /* lockstep */

    struct timing compute, wakeup;
    int64_t overruns, slips, bad_states;
    int64_t page_faults; /* before the first tick */
    int overruns_in_a_row;

    pthread_t thread;
    sem_t started;
    int start_result;
    char start_error[200];
    _Atomic(const struct config *) offered;
    _Atomic bool ending;
    _Atomic int64_t ticks;
    _Atomic int state; /* state * 256 + fault, so that both are of one tick */
    _Atomic int waits;
};

/* Takes the requests that have come. */
void loop_take_requests(struct loop *loop);

/* The tick's first call, and its command and sample on their way. */
void loop_decide(struct loop *loop, int64_t now);

/* The tick's last call, and status and trace on their way. */
void loop_report(struct loop *loop, int64_t now);

/* Tick after tick, until the loop is to end. */
void loop_run_lockstep(struct loop *loop);
void loop_run_real_time(struct loop *loop);

static inline void loop_set_waits(struct loop *loop, enum loop_wait waits)
{
    atomic_store_explicit(&loop->waits, (int)waits, memory_order_relaxed);
}

static inline bool loop_ending(const struct loop *loop)
{
    return atomic_load_explicit(&loop->ending, memory_order_relaxed);
}

#endif
