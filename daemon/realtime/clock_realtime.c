#include "daemon/realtime/loop_private.h"

#include "common/base/thread.h"
#include "common/bus/open.h"
#include "daemon/control/inputs.h"
#include "daemon/realtime/grid.h"

#include <math.h>
#include <time.h>

static const double learning_share = 0.6; /* of the period, after which no learning is begun */

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
        inputs->state = received.state;
        inputs->state_checksum = received.checksum;
        loop->any_state = true;
    }
    inputs->state_age =
        loop->any_state ? (double)(bus_monotonic_us() - loop->received.received) * 1e-6 : INFINITY;
    inputs->n_observations = 0;
    while (inputs->n_observations < TICK_MAX_OBSERVATIONS &&
           mailbox_take(daemon_bus_observations(loop->bus),
                        &inputs->observation[inputs->n_observations]))
        inputs->n_observations++;
    loop_take_requests(loop);
    inputs->overrunning = loop->overruns_in_a_row >= loop->config->overruns_fault;
}

static int64_t monotonic_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
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
    loop_decide(loop, now);
    timing_add(&loop->compute, (double)(monotonic_ns() - woken) * 1e-3);
    while (monotonic_ns() < learn_until && tick_learn(loop->tick))
        ;
    loop_report(loop, now);
    account(loop, due, period);
}

void loop_run_real_time(struct loop *loop)
{
    int64_t period = (int64_t)(loop->config->period * 1e9);
    int64_t due = monotonic_ns() + period;

    while (!loop_ending(loop)) {
        sleep_until(due);
        step_real_time(loop, due, period);
        due = grid_next(due, monotonic_ns(), period, &loop->inputs.slipped);
        loop->slips += loop->inputs.slipped;
    }
}
