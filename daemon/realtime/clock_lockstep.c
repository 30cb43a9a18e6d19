#include "daemon/realtime/loop_private.h"

#include "common/bus/open.h"

#include <time.h>

static const int lockstep_poll_ms = 100; /* how soon a waiting loop sees that it is to end */

/* Lockstep: until a message comes, or for a while. */
static void wait_for_message(struct loop *loop, enum loop_wait waits)
{
    if (!daemon_bus_wait(loop->bus, lockstep_poll_ms))
        loop_set_waits(loop, waits);
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
        if (loop_ending(loop))
            return false;
        wait_for_message(loop, LOOP_WAITS_FOR_OBSERVATION);
    }
    loop_set_waits(loop, LOOP_RUNS);
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

    while (tick_awaits_store(loop->tick) && !loop_ending(loop)) {
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
    await_store(loop);
    begin = bus_monotonic_us();
    loop->any_state = true;
    loop->inputs.has_state = true;
    loop->inputs.state = *state;
    loop->inputs.state_checksum = loop->received.checksum;
    loop->inputs.state_age = 0;
    loop_take_requests(loop);
    loop_decide(loop, state->utime);
    timing_add(&loop->compute, (double)(bus_monotonic_us() - begin));
    learn_quota(loop);
    loop_report(loop, state->utime);
}

void loop_run_lockstep(struct loop *loop)
{
    int64_t answered = 0;

    while (!loop_ending(loop)) {
        if (!mailbox_take(daemon_bus_states(loop->bus), &loop->received)) {
            wait_for_message(loop, LOOP_WAITS_FOR_STATE);
            continue;
        }
        loop_set_waits(loop, LOOP_RUNS);
        if (loop->received.state.seq == answered && loop->outputs.has_command) {
            daemon_bus_send_command(loop->bus, &loop->outputs.command); /* it was lost */
            continue;
        }
        step_lockstep(loop);
        answered = loop->received.state.seq;
    }
}
