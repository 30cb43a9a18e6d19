#include "daemon/realtime/clock.h"

#include "common/bus/open.h"
#include "daemon/control/inputs.h"
#include "daemon/realtime/due_observations.h"

#include <time.h>

static const int lockstep_poll_ms = 100; /* how soon a waiting loop sees that it is to end */

/* Lockstep: until a message comes, or for a while. */
static void wait_for_message(struct step *step, enum loop_wait waits)
{
    if (!daemon_bus_wait(step->bus, lockstep_poll_ms))
        step_set_waits(step, waits);
    watchdog_feed(step->watchdog, NULL);
}

/* The observation that the state says is due with it, of the sense that this task space has. */
static int64_t due_with(const struct step *step, const reach_robot_state_t *state)
{
    return step->config->space.kind == SPACE_CARTESIAN ? state->effector_due : state->vision_due;
}

/* Waits for the observation of this instant; later ones stay in `waiting`. Returns false when the
 * loop is to end. */
static bool wait_for_observation(struct step *step, struct due_observations *waiting, int64_t due)
{
    struct tick_inputs *inputs = &step->inputs;
    struct observation observation;

    for (;;) {
        while (mailbox_take(daemon_bus_observations(step->bus), &observation))
            due_observations_add(waiting, &observation);
        if (due_observations_ready(waiting, due))
            break;
        if (step_ending(step))
            return false;
        wait_for_message(step, LOOP_WAITS_FOR_OBSERVATION);
    }
    step_set_waits(step, LOOP_RUNS);
    inputs->n_observations = 0;
    while (inputs->n_observations < TICK_MAX_OBSERVATIONS &&
           due_observations_take(waiting, due, &inputs->observation[inputs->n_observations]))
        inputs->n_observations++;
    return true;
}

/* The simulator holds the clock: a run's bytes must not depend on how fast the disk is. */
static void await_store(struct step *step)
{
    const struct timespec moment = {.tv_nsec = 1000000};

    while (tick_awaits_store(step->tick) && !step_ending(step)) {
        nanosleep(&moment, NULL);
        watchdog_feed(step->watchdog, NULL);
    }
}

static void learn_quota(struct step *step)
{
    for (int i = 0; i < step->config->learner_quota; i++) {
        await_store(step);
        if (!tick_learn(step->tick))
            break;
    }
}

/* One period of lockstep for a state that was not answered yet. */
static void step_lockstep(struct step *step, struct due_observations *waiting)
{
    const reach_robot_state_t *state = &step->received.state;
    struct state_fault fault;
    int64_t begin;

    step->inputs.n_observations = 0;
    step->inputs.crossed = 0;
    if (inputs_state_ok(step->config, state, &fault)) {
        if (step->any_state && state->utime < step->newest_utime)
            due_observations_init(waiting); /* the simulator began anew */
        if (!wait_for_observation(step, waiting, due_with(step, state)))
            return;
        step->inputs.crossed = senders_cross(&step->senders, state);
        step->any_state = true;
        step->newest_utime = state->utime;
    } /* else it is answered at once: what it says is due may never come */
    await_store(step);
    begin = bus_monotonic_us();
    step->inputs.has_state = true;
    step->inputs.state = *state;
    step->inputs.state_checksum = step->received.checksum;
    step->inputs.state_age = 0;
    step_take_requests(step);
    step_decide(step, state->utime);
    duration_histogram_add(&step->compute, (double)(bus_monotonic_us() - begin));
    learn_quota(step);
    step_report(step, state->utime);
}

void clock_run_lockstep(struct step *step)
{
    struct due_observations waiting;
    int64_t answered = 0;

    due_observations_init(&waiting);
    while (!step_ending(step)) {
        if (!daemon_bus_take_state(step->bus, &step->received)) {
            wait_for_message(step, LOOP_WAITS_FOR_STATE);
            continue;
        }
        step_set_waits(step, LOOP_RUNS);
        if (step->received.state.seq == answered && step->outputs.has_command) {
            daemon_bus_send_command(step->bus, &step->outputs.command); /* it was lost */
            continue;
        }
        step_lockstep(step, &waiting);
        answered = step->received.state.seq;
    }
}
