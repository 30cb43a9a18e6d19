/* What comes into a tick: the robot's state, checked in itself, against the one before and against
 * what was commanded; and what its senses have seen. */
#include "daemon/control/inputs.h"
#include "daemon/control/senses/senders.h"
#include "daemon/control/tick_private.h"

#include <math.h>
#include <string.h>

static const int64_t overtaken_us = SENDERS_OVERTAKEN;
static const int64_t forgotten_us = 1000000; /* less than the joints are remembered */

/* The robot's clock was set back: what was seen belongs to another time. */
static void begin_anew(struct tick *tick)
{
    following_forget(&tick->following);
    history_init(&tick->history, config_joints(tick->config));
    sight_init(&tick->sight, tick->config);
    tick->estimate.moved_from = false;
}

/* While the loop or the states are late, motion and command are not of one time. */
static void follow(struct tick *tick, const struct tick_inputs *inputs)
{
    bool together = tick->state_known && tick->state_age <= tick->config->safety_state_hold &&
                    inputs->slipped == 0 && inputs->braked == 0 && inputs->crossed == 0 &&
                    !inputs->robot_rests;

    if (tick->following.joint)
        return; /* what was found stays until a reset */
    if (together)
        following_look(&tick->following, tick->safety.previous, tick->q);
    else
        following_forget(&tick->following);
}

/* Overtaken on its way by a newer one, or seen before. A robot that starts anew begins with
 * number 1, one whose clock is set back goes back farther. */
static bool is_late(const struct tick *tick, const reach_robot_state_t *state)
{
    return tick->state_known && state->seq > 1 && state->seq <= tick->state_seq &&
           state->utime <= tick->state_utime && tick->state_utime - state->utime < overtaken_us;
}

/* Counts it, and keeps what was wrong. In lockstep its sender waits for an answer. */
static bool refuse_state(struct tick *tick, const reach_robot_state_t *state, int reason,
                         const struct state_fault *fault)
{
    struct refusals *refusals = &tick->refusals;

    refusals_add(refusals, REACH_STATUS_T_CHANNEL_STATE, reason);
    refusals->state_seq = state->seq;
    refusals->state = *fault;
    tick->unanswered = state->lockstep ? state->seq : 0;
    return false;
}

static bool is_good(struct tick *tick, const struct tick_inputs *inputs)
{
    const reach_robot_state_t *state = &inputs->state;
    struct state_fault fault;
    bool good, jumps;

    tick->unanswered = 0;
    if (!inputs->has_state)
        return false;
    if (is_late(tick, state)) {
        refusals_add(&tick->refusals, REACH_STATUS_T_CHANNEL_STATE, REACH_STATUS_T_TIME);
        return false;
    }
    good = inputs_state_ok(tick->config, state, &fault);
    jumps = (good || fault.joint > 0) &&
            plausible_strikes_jump(&tick->plausible, state, good, tick->time);
    if (!good)
        return refuse_state(tick, state, REACH_STATUS_T_VALUE, &fault);
    if (jumps)
        return refuse_state(tick, state, REACH_STATUS_T_JUMP, &tick->plausible.jump);
    plausible_believe(&tick->plausible, state);
    return true;
}

/* Takes the state in. A bad one is dropped, the last good one kept until it is stale. */
static void take_state(struct tick *tick, const struct tick_inputs *inputs)
{
    const reach_robot_state_t *state = &inputs->state;

    tick->state_seq_now = 0;
    plausible_crossed(&tick->plausible, inputs->crossed, tick->time);
    if (!is_good(tick, inputs)) {
        tick->state_age = fmax(inputs->state_age, tick->state_age + tick->config->period);
        return;
    }
    tick->state_age = inputs->state_age;
    safety_measured(&tick->safety);
    if (tick->state_known && state->utime <= tick->state_utime)
        begin_anew(tick);
    tick->state_utime = state->utime;
    tick->state_seq_now = state->seq;
    tick->state_seq = state->seq;
    tick->state_known = true;
    memcpy(tick->q, state->position, sizeof tick->q);
    history_push(&tick->history, state->utime, state->position);
}

/* Of a time of which no joints are known, nor soon will be. One that is only newer than the newest
 * state, or was overtaken, is nothing to be told of. */
static bool is_of_another_time(const struct tick *tick, const struct observation *observation)
{
    int64_t ahead = observation->utime - tick->state_utime;

    return tick->state_known && (ahead > overtaken_us || ahead < -forgotten_us);
}

static void take_observations(struct tick *tick, const struct tick_inputs *inputs)
{
    tick->marker_seq_now = 0;
    tick->sight.new_frame = false;
    for (int i = 0; i < inputs->n_observations; i++) {
        if (!inputs_observation_ok(tick->config, &inputs->observation[i]))
            refusals_add(&tick->refusals, REACH_STATUS_T_CHANNEL_SENSE, REACH_STATUS_T_VALUE);
        else if (sight_observe(&tick->sight, &inputs->observation[i], &tick->history))
            tick->marker_seq_now = inputs->observation[i].seq;
        else if (is_of_another_time(tick, &inputs->observation[i]))
            refusals_add(&tick->refusals, REACH_STATUS_T_CHANNEL_SENSE, REACH_STATUS_T_TIME);
    }
}

void tick_take_inputs(struct tick *tick, const struct tick_inputs *inputs)
{
    take_state(tick, inputs);
    follow(tick, inputs);
    take_observations(tick, inputs);
}
