#include "loop.h"

#include "common/bus.h"
#include "confine.h"
#include "due_observations.h"
#include "grid.h"
#include "inputs.h"
#include "realtime.h"
#include "timing.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static const int lockstep_poll_ms = 100;  /* how soon a waiting loop sees that it is to end */
static const double learning_share = 0.6; /* of the period, after which no learning is begun */

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

size_t loop_memory(void)
{
    return arena_footprint(sizeof(struct loop));
}

struct loop *loop_create(const struct config *config, struct tick *tick, struct daemon_bus *bus,
                         struct watchdog *watchdog, bool lockstep, bool real_time,
                         struct arena *arena)
{
    struct loop *loop = arena_alloc(arena, sizeof *loop);

    if (!loop)
        return NULL;
    loop->config = config;
    loop->tick = tick;
    loop->bus = bus;
    loop->watchdog = watchdog;
    loop->lockstep = lockstep;
    loop->real_time = real_time;
    return loop;
}

int64_t loop_ticks(const struct loop *loop)
{
    return atomic_load_explicit(&loop->ticks, memory_order_relaxed);
}

struct loop_state loop_state(const struct loop *loop)
{
    int both = atomic_load_explicit(&loop->state, memory_order_relaxed);

    return (struct loop_state){.state = (int8_t)(both / 256), .fault = (int8_t)(both % 256)};
}

enum loop_wait loop_waits(const struct loop *loop)
{
    return (enum loop_wait)atomic_load_explicit(&loop->waits, memory_order_relaxed);
}

const struct config *loop_offer_config(struct loop *loop, const struct config *config)
{
    return atomic_exchange_explicit(&loop->offered, config, memory_order_acq_rel);
}

static void set_waits(struct loop *loop, enum loop_wait waits)
{
    atomic_store_explicit(&loop->waits, (int)waits, memory_order_relaxed);
}

static bool ending(const struct loop *loop)
{
    return atomic_load_explicit(&loop->ending, memory_order_relaxed);
}

static void take_requests(struct loop *loop)
{
    struct tick_inputs *inputs = &loop->inputs;

    inputs->n_requests = 0;
    while (inputs->n_requests < TICK_MAX_REQUESTS &&
           mailbox_take(daemon_bus_requests(loop->bus), &inputs->request[inputs->n_requests]))
        inputs->n_requests++;
}

static void decide(struct loop *loop, int64_t now)
{
    loop->inputs.config = loop_offer_config(loop, NULL);
    if (loop->inputs.config)
        loop->config = loop->inputs.config;
    loop->inputs.emergency = daemon_bus_take_emergency(loop->bus);
    loop->inputs.braked = watchdog_take_braked(loop->watchdog);
    tick_decide(loop->tick, &loop->inputs, now, &loop->outputs);
    if (loop->outputs.has_command)
        daemon_bus_send_command(loop->bus, &loop->outputs.command);
    watchdog_feed(loop->watchdog, loop->outputs.has_command ? &loop->outputs.command : NULL);
    if (loop->outputs.has_sample)
        daemon_bus_send_sample(loop->bus, &loop->outputs.sample);
}

static void report(struct loop *loop, int64_t now)
{
    reach_status_t *status = &loop->outputs.status;

    tick_report(loop->tick, now, &loop->outputs);
    status->compute_us = loop->compute.last;
    status->compute_mean_us = timing_mean(&loop->compute);
    status->compute_p999_us = timing_quantile(&loop->compute, 0.999);
    status->compute_max_us = loop->compute.max;
    status->wakeup_us = loop->wakeup.last;
    status->wakeup_mean_us = timing_mean(&loop->wakeup);
    status->wakeup_p999_us = timing_quantile(&loop->wakeup, 0.999);
    status->wakeup_max_us = loop->wakeup.max;
    status->page_faults = realtime_page_faults() - loop->page_faults;
    status->overruns = loop->overruns;
    status->slips = loop->slips;
    status->bad_inputs += daemon_bus_refused(loop->bus) + loop->bad_states;
    daemon_bus_send_report(loop->bus, status, &loop->outputs.trace);
    atomic_store_explicit(&loop->state, status->state * 256 + status->fault, memory_order_relaxed);
    atomic_fetch_add_explicit(&loop->ticks, 1, memory_order_relaxed);
}

/* Lockstep: until a message comes, or for a while. */
static void wait_for_message(struct loop *loop, enum loop_wait waits)
{
    if (!daemon_bus_wait(loop->bus, lockstep_poll_ms))
        set_waits(loop, waits);
    watchdog_feed(loop->watchdog, NULL);
}

/* The observation that the state says is due with it, of the sense that this task space has. */
static int64_t due_with(const struct loop *loop, const reach_robot_state_t *state)
{
    return loop->config->space.kind == SPACE_CARTESIAN ? state->effector_due : state->vision_due;
}

/* Waits for the observation of this instant. Returns false when the loop is to end. */
static bool wait_for_observation(struct loop *loop, int64_t due)
{
    struct tick_inputs *inputs = &loop->inputs;
    struct observation observation;

    for (;;) {
        while (mailbox_take(daemon_bus_observations(loop->bus), &observation))
            due_observations_add(&loop->due, &observation);
        if (due_observations_ready(&loop->due, due))
            break;
        if (ending(loop))
            return false;
        wait_for_message(loop, LOOP_WAITS_FOR_OBSERVATION);
    }
    set_waits(loop, LOOP_RUNS);
    inputs->n_observations = 0;
    while (inputs->n_observations < TICK_MAX_OBSERVATIONS &&
           due_observations_take(&loop->due, due, &inputs->observation[inputs->n_observations]))
        inputs->n_observations++;
    return true;
}

/* The simulator holds the clock: a run's bytes must not depend on how fast the disk is. */
static void await_store(struct loop *loop)
{
    const struct timespec moment = {.tv_nsec = 1000000};

    while (tick_awaits_store(loop->tick) && !ending(loop)) {
        nanosleep(&moment, NULL);
        watchdog_feed(loop->watchdog, NULL);
    }
}

static void learn_quota(struct loop *loop)
{
    for (int i = 0; i < loop->config->learner_quota; i++) {
        await_store(loop);
        if (!tick_learn(loop->tick))
            break;
    }
}

/* One period of lockstep for a state that was not answered yet. */
static void step_lockstep(struct loop *loop)
{
    const reach_robot_state_t *state = &loop->received.state;
    int64_t begin;

    if (loop->any_state && state->utime < loop->inputs.state.utime)
        due_observations_init(&loop->due); /* the simulator began anew */
    if (!wait_for_observation(loop, due_with(loop, state)))
        return;
    begin = bus_monotonic_us();
    loop->any_state = true;
    loop->inputs.has_state = true;
    loop->inputs.state = *state;
    loop->inputs.state_age = 0;
    take_requests(loop);
    decide(loop, state->utime);
    timing_add(&loop->compute, (double)(bus_monotonic_us() - begin));
    learn_quota(loop);
    report(loop, state->utime);
}

static void run_lockstep(struct loop *loop)
{
    int64_t answered = 0;

    while (!ending(loop)) {
        if (!mailbox_take(daemon_bus_states(loop->bus), &loop->received)) {
            wait_for_message(loop, LOOP_WAITS_FOR_STATE);
            continue;
        }
        set_waits(loop, LOOP_RUNS);
        if (loop->received.state.seq == answered && loop->outputs.has_command) {
            daemon_bus_send_command(loop->bus, &loop->outputs.command); /* it was lost */
            continue;
        }
        step_lockstep(loop);
        answered = loop->received.state.seq;
    }
}

/* Real time: whatever has come counts now. */
static void take_all(struct loop *loop)
{
    struct tick_inputs *inputs = &loop->inputs;
    struct received_state received;

    inputs->has_state = false;
    while (mailbox_take(daemon_bus_states(loop->bus), &received)) {
        if (!inputs_state_ok(loop->config, &received.state)) {
            loop->bad_states++; /* and hides no good one of the same period */
            continue;
        }
        loop->received = received;
        inputs->has_state = true;
        inputs->state = loop->received.state;
        loop->any_state = true;
    }
    inputs->state_age =
        loop->any_state ? (double)(bus_monotonic_us() - loop->received.received) * 1e-6 : INFINITY;
    inputs->n_observations = 0;
    while (inputs->n_observations < TICK_MAX_OBSERVATIONS &&
           mailbox_take(daemon_bus_observations(loop->bus),
                        &inputs->observation[inputs->n_observations]))
        inputs->n_observations++;
    take_requests(loop);
    inputs->overrunning = loop->overruns_in_a_row >= loop->config->overruns_fault;
}

static int64_t monotonic_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void sleep_until(int64_t ns)
{
    struct timespec due = {.tv_sec = ns / 1000000000, .tv_nsec = ns % 1000000000};

    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL) == EINTR)
        ;
}

/* Late is what ends after the period that began at `due`, whether it woke late or took long. */
static void account(struct loop *loop, int64_t due, int64_t period)
{
    bool late = monotonic_ns() - due > period;

    loop->overruns += late;
    loop->overruns_in_a_row = late ? loop->overruns_in_a_row + 1 : 0;
}

/* One period of real time: the command first, then what learning the slack allows. */
static void step_real_time(struct loop *loop, int64_t due, int64_t period)
{
    int64_t woken = monotonic_ns();
    int64_t learn_until = woken + (int64_t)(learning_share * (double)period);
    int64_t now = bus_utime();

    timing_add(&loop->wakeup, (double)(woken - due) * 1e-3);
    take_all(loop);
    loop->inputs.robot_rests = (double)(woken - due) * 1e-9 > loop->config->loop_stall;
    decide(loop, now);
    timing_add(&loop->compute, (double)(monotonic_ns() - woken) * 1e-3);
    while (monotonic_ns() < learn_until && tick_learn(loop->tick))
        ;
    report(loop, now);
    account(loop, due, period);
}

static void run_real_time(struct loop *loop)
{
    int64_t period = (int64_t)(loop->config->period * 1e9);
    int64_t due = monotonic_ns() + period;

    while (!ending(loop)) {
        sleep_until(due);
        step_real_time(loop, due, period);
        due = grid_next(due, monotonic_ns(), period, &loop->inputs.slipped);
        loop->slips += loop->inputs.slipped;
    }
}

/* The robot must not go on with the last velocity when nobody steers it any more. */
static void send_rest(struct loop *loop)
{
    if (!loop->outputs.has_command)
        return;
    memset(loop->outputs.command.velocity, 0, sizeof loop->outputs.command.velocity);
    daemon_bus_send_command(loop->bus, &loop->outputs.command);
}

/* From here on the thread asks the system for nothing that is not in confine.c. */
static int enter(struct loop *loop)
{
    if (loop->real_time &&
        realtime_enter(REALTIME_PRIORITY_LOOP, loop->start_error, sizeof loop->start_error))
        return -1;
    realtime_touch_stack();
    if (confine_thread(loop->start_error, sizeof loop->start_error))
        return -1;
    loop->page_faults = realtime_page_faults();
    return 0;
}

static void *run(void *user)
{
    struct loop *loop = user;

    pthread_setname_np(pthread_self(), "reachd-loop");
    loop->start_result = enter(loop);
    sem_post(&loop->started);
    if (loop->start_result)
        return NULL;
    if (loop->lockstep)
        run_lockstep(loop);
    else
        run_real_time(loop);
    send_rest(loop);
    return NULL;
}

int loop_start(struct loop *loop, char *error, size_t error_size)
{
    if (sem_init(&loop->started, 0, 0)) {
        snprintf(error, error_size, "%s", strerror(errno));
        return -1;
    }
    if (loop->real_time && realtime_lock_memory(error, error_size))
        return -1;
    if (realtime_thread(&loop->thread, 0, run, loop, error, error_size))
        return -1;
    while (sem_wait(&loop->started) && errno == EINTR)
        ;
    if (loop->start_result) {
        pthread_join(loop->thread, NULL);
        snprintf(error, error_size, "%s", loop->start_error);
    }
    return loop->start_result;
}

void loop_stop(struct loop *loop)
{
    atomic_store_explicit(&loop->ending, true, memory_order_relaxed);
    pthread_join(loop->thread, NULL);
}
