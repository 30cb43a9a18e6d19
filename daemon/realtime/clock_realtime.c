#include "daemon/realtime/clock.h"

#include "common/base/thread.h"
#include "common/bus/open.h"
#include "daemon/control/inputs.h"
#include "daemon/realtime/sleep_policy.h"

#include <math.h>
#include <time.h>

static const double learning_share = 0.6; /* of the period, after which no learning is begun */

/* The newest good state of the period. Where there is none, the tick gets a bad one, to refuse it
 * and say why; other bad ones are counted here. */
static void take_newest_state(struct step *step)
{
    struct tick_inputs *inputs = &step->inputs;
    struct received_state received;
    struct state_fault fault;
    bool any_good = false;

    inputs->has_state = false;
    inputs->crossed = 0;
    while (daemon_bus_take_state(step->bus, &received)) {
        bool good = inputs_state_ok(step->config, &received.state, &fault);
        if (inputs->has_state && !(any_good && good))
            refusals_add(&step->refusals, REACH_STATUS_T_CHANNEL_STATE, REACH_STATUS_T_VALUE);
        if (!good) {
            step->refusals.state_seq = received.state.seq;
            step->refusals.state = fault;
        }
        if (any_good && !good)
            continue;
        inputs->has_state = true;
        inputs->state = received.state;
        inputs->state_checksum = received.checksum;
        if (!good)
            continue;
        inputs->crossed += senders_cross(&step->senders, &received.state);
        any_good = step->any_state = true;
        step->received = received;
    }
}

/* Real time: whatever has come counts now. */
static void take_inputs(struct step *step)
{
    struct tick_inputs *inputs = &step->inputs;

    take_newest_state(step);
    inputs->state_age =
        step->any_state ? (double)(bus_monotonic_us() - step->received.received) * 1e-6 : INFINITY;
    inputs->n_observations = 0;
    while (inputs->n_observations < TICK_MAX_OBSERVATIONS &&
           mailbox_take(daemon_bus_observations(step->bus),
                        &inputs->observation[inputs->n_observations]))
        inputs->n_observations++;
    step_take_requests(step);
    inputs->overrunning = step->overruns_in_a_row >= step->config->safety_overruns_fault;
}

static int64_t monotonic_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* Late is what ends after the period that began at `due`, whether it woke late or took long. */
static void account(struct step *step, int64_t due, int64_t period)
{
    bool late = monotonic_ns() - due > period;

    step->overruns += late;
    step->overruns_in_a_row = late ? step->overruns_in_a_row + 1 : 0;
}

/* One period of real time: the command first, then what learning the slack allows. */
static void step_real_time(struct step *step, int64_t due, int64_t period)
{
    int64_t woken = monotonic_ns();
    int64_t learn_until = woken + (int64_t)(learning_share * (double)period);
    int64_t now = bus_utime();

    duration_histogram_add(&step->wakeup, (double)(woken - due) * 1e-3);
    take_inputs(step);
    step->inputs.robot_rests = (double)(woken - due) * 1e-9 > step->config->safety_loop_stall;
    step_decide(step, now);
    duration_histogram_add(&step->compute, (double)(monotonic_ns() - woken) * 1e-3);
    while (monotonic_ns() < learn_until && tick_learn(step->tick))
        ;
    step_report(step, now);
    account(step, due, period);
}

void clock_run_real_time(struct step *step)
{
    int64_t period = (int64_t)(step->config->period * 1e9);
    int64_t due = monotonic_ns() + period;

    while (!step_ending(step)) {
        sleep_until(due);
        step_real_time(step, due, period);
        due = sleep_policy_next(due, monotonic_ns(), period, &step->inputs.slipped);
        step->slips += step->inputs.slipped;
    }
}
