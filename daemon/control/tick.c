#include "daemon/control/tick.h"

#include "daemon/control/behaviours/behaviour.h"
#include "daemon/control/behaviours/gaze.h"
#include "daemon/control/kinematics/estimate.h"
#include "daemon/control/limits/motion.h"
#include "daemon/control/limits/safety.h"
#include "daemon/control/sample_queue.h"
#include "daemon/control/senses/joint_history.h"
#include "daemon/control/senses/sight.h"
#include "daemon/control/supervisor.h"
#include "daemon/control/tick_private.h"
#include "daemon/control/trace.h"

#include <math.h>
#include <string.h>

static const int8_t fault_of_following[] = {
    [FOLLOWING_STILL] = REACH_STATUS_T_FAULT_STILL,
    [FOLLOWING_REVERSED] = REACH_STATUS_T_FAULT_REVERSED,
    [FOLLOWING_ASTRAY] = REACH_STATUS_T_FAULT_ASTRAY,
};

size_t tick_memory(const struct config *config)
{
    struct learner_config learner = config_learner(config);
    size_t learner_bytes = learner_memory(&learner);

    return arena_footprint(sizeof(struct tick)) + learner_bytes +
           sample_queue_memory(config->learner_queue);
}

struct tick *tick_create(const struct tick_settings *settings, struct arena *arena, char *error,
                         size_t error_size)
{
    const struct config *config = settings->config;
    struct learner_config learner = config_learner(config);
    struct tick *tick = arena_alloc(arena, sizeof *tick);

    if (!tick || sample_queue_init(&tick->queue, config->learner_queue, arena)) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    tick->config = config;
    tick->model = settings->model;
    tick->behaviours = settings->behaviours ? settings->behaviours : behaviour_table;
    tick->learner = learner_create(&learner, arena, error, error_size);
    if (!tick->learner)
        return NULL;
    health_init(&tick->health, &learner, HEALTH_WINDOW);
    plausible_init(&tick->plausible, config);
    following_init(&tick->following, config);
    history_init(&tick->history, config_joints(config));
    sight_init(&tick->sight, config);
    witness_init(&tick->witness, config);
    estimate_init(&tick->estimate, config_arm_joints(config), SPACE_DIMENSIONS,
                  config->space.scale);
    context_init(&tick->context);
    gaze_init(&tick->gaze, config);
    safety_init(&tick->safety, config);
    return tick;
}

struct learner *tick_learner(struct tick *tick)
{
    return tick->learner;
}

bool tick_awaits_store(const struct tick *tick)
{
    const struct model_port *model = &tick->model;

    return model->ops->works(model->context) ||
           (sample_queue_oldest(&tick->queue) && model->ops->full(model->context));
}

bool tick_learn(struct tick *tick)
{
    const struct queued_sample *sample = sample_queue_oldest(&tick->queue);
    const struct model_port *model = &tick->model;

    if (!sample || !model->ops->note(model->context, sample->z, sample->x))
        return false;
    health_count(&tick->health, sample_queue_learn_one(&tick->queue, tick->learner));
    model->ops->learned(model->context, tick->learner);
    tick->learned_now++;
    return true;
}

/* The output is measured, wherever the end-effector is: the estimate of eq. 14 starts from it. */
static void anchor_to_measured(struct tick *tick)
{
    struct pair pair;

    sight_pair(&tick->sight, 1, pair.q, pair.x, &pair.utime);
    tick_anchor(tick, &pair);
}

/* Predicts at the present joints, chooses the solution, carries what was seen to now. */
static void sense(struct tick *tick)
{
    if (tick->state_seq_now) {
        estimate_integrate(&tick->estimate, tick->q);
        if (tick->sight.new_frame && !tick->config->space.fixates)
            anchor_to_measured(tick);
        estimate_choose(&tick->estimate, tick->learner, tick->q);
        health_count_solutions(&tick->health, tick->estimate.prediction.n_solutions);
        context_follow(&tick->context, &tick->estimate);
    }
    if (tick->sight.new_frame)
        witness_look(&tick->witness, &tick->sight, &tick->estimate.prediction, tick->time);
    sight_carry(&tick->sight, tick->q, estimate_jacobian(&tick->estimate));
}

static uint32_t conditions(const struct tick *tick, const struct tick_inputs *inputs)
{
    uint32_t set = 0;

    if (tick->state_known)
        set |= CONDITION_STATE_KNOWN;
    if (tick->state_age <= tick->config->safety_state_hold && !tick->unanswered &&
        !plausible_doubts(&tick->plausible, tick->time))
        set |= CONDITION_STATE_FRESH;
    if (tick->state_age <= tick->config->safety_state_suspend)
        set |= CONDITION_STATE_ALIVE;
    if (tick->behaviour.ops)
        set |= CONDITION_BUSY;
    if (inputs->overrunning)
        set |= CONDITION_OVERRUNNING;
    if (inputs->emergency || tick->emergency_requested)
        set |= CONDITION_EMERGENCY;
    if (inputs->braked > 0)
        set |= CONDITION_STALLED;
    if (tick->reset_requested)
        set |= CONDITION_RESET_REQUESTED;
    if (plausible_jumps(&tick->plausible, tick->time))
        set |= CONDITION_JUMPS;
    if (tick->following.joint)
        set |= CONDITION_ASTRAY;
    if (plausible_two_senders(&tick->plausible, tick->time))
        set |= CONDITION_SENDERS;
    return set;
}

/* Which joint a new fault is of. */
static void name_fault(struct tick *tick, int8_t before)
{
    if (tick->fault == before)
        return;
    tick->fault_joint = 0;
    if (tick->fault == REACH_STATUS_T_FAULT_JUMP) {
        tick->fault_joint = tick->plausible.jump.joint;
        tick->fault_value = tick->plausible.jumped;
    } else if (tick->fault == REACH_STATUS_T_FAULT_ASTRAY) {
        tick->fault = fault_of_following[tick->following.fault];
        tick->fault_joint = tick->following.joint;
        tick->fault_value = tick->following.missed;
    }
}

static void supervise(struct tick *tick, const struct tick_inputs *inputs)
{
    uint32_t set = conditions(tick, inputs);
    int8_t before = tick->fault;

    tick->state = supervisor_next(tick->state, set);
    tick->fault = supervisor_fault(tick->state, set, before);
    name_fault(tick, before);
    tick->reset_requested = false;
    tick->emergency_requested = false;
    /* A fault ends the work: what was wanted before it may no longer be. */
    if (tick->state == SUPERVISOR_FAULT)
        tick->behaviour.ops = NULL;
}

/* What the behaviour wants, shaped; rest when none runs. What the supervisor stops is stopped by
 * the gate alone, as fast as the robot may. */
static void behave(struct tick *tick, const struct senses *senses, struct wants *wants)
{
    const struct config *config = tick->config;
    int n_arm = config_arm_joints(config);

    if (tick->state != SUPERVISOR_ACTIVE && tick->state != SUPERVISOR_IDLE)
        return;
    if (tick->state == SUPERVISOR_ACTIVE && tick->behaviour.ops &&
        !tick->behaviour.ops->step(&tick->behaviour, senses, wants)) {
        tick->behaviour.ops = NULL;
        memset(wants->velocity, 0, sizeof wants->velocity);
    }
    motion_shape(config, 0, n_arm, tick->q, tick->safety.previous, wants->velocity);
    motion_shape(config, n_arm, config_head_joints(config), tick->q, tick->safety.previous,
                 wants->velocity);
}

static void fill_command(struct tick *tick, const struct wants *wants, int64_t now,
                         struct tick_outputs *outputs)
{
    reach_robot_command_t *command = &outputs->command;

    outputs->has_command = tick->state_known || tick->unanswered;
    *command =
        (reach_robot_command_t){.utime = now,
                                .seq = tick->seq,
                                .state_seq = tick->unanswered ? tick->unanswered : tick->state_seq,
                                .n_joints = config_joints(tick->config)};
    memcpy(command->velocity, wants->velocity, sizeof command->velocity);
    safety_gate(&tick->safety, tick->q, command->velocity);
}

/* Nothing that was built on the old one depends on what may differ (reload.h). */
static void take_config(struct tick *tick, const struct config *config)
{
    tick->config = config;
    tick->sight.config = config;
    tick->witness.config = config;
    tick->gaze.config = config;
    tick->safety.config = config;
    tick->plausible.config = config;
    tick->following.config = config;
}

/* Counted on the loop's grid, which no clock that is set moves. */
static int64_t advance_time(struct tick *tick, const struct tick_inputs *inputs, int64_t now)
{
    int64_t periods = 1 + inputs->slipped + inputs->unseen;

    tick->time =
        tick->time ? tick->time + periods * (int64_t)(tick->config->period * 1e6 + 0.5) : now;
    return tick->time;
}

void tick_decide(struct tick *tick, const struct tick_inputs *inputs, int64_t now,
                 struct tick_outputs *outputs)
{
    const struct senses senses = {
        .config = inputs->config ? inputs->config : tick->config,
        .now = now,
        .time = advance_time(tick, inputs, now),
        .q = tick->q,
        .previous = tick->safety.previous,
        .sight = &tick->sight,
        .estimate = &tick->estimate,
        .learner = tick->learner,
        .imagined = &tick->imagined,
    };
    struct wants wants = {.gaze = &tick->gaze, .tried = &tick->tried};

    if (inputs->config)
        take_config(tick, inputs->config);
    tick->seq += 1 + inputs->unseen;
    tick->learned_now = 0;
    safety_held(&tick->safety, inputs->slipped);
    if (inputs->braked > 0)
        safety_was_braked(&tick->safety, inputs->braked);
    else if (inputs->robot_rests)
        safety_rests(&tick->safety);
    outputs->has_sample = false;
    trace_inputs(inputs, &outputs->trace);
    outputs->trace.fresh = !tick->touched;
    tick->touched = tick->touched || trace_inputs_matter(inputs);
    tick_take_inputs(tick, inputs);
    sense(tick);
    tick_take_requests(tick, inputs, &senses, &wants);
    supervise(tick, inputs);
    behave(tick, &senses, &wants);
    if (wants.has_pair)
        tick_take_pair(tick, &wants.pair, outputs);
    tick->has_target = wants.has_target;
    memcpy(tick->target, wants.target, sizeof tick->target);
    fill_command(tick, &wants, now, outputs);
}
