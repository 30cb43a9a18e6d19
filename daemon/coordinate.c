/* Arm-head coordination (paper section 7.2): the head turns to targets, the arm keeps the marker
 * in fixation. */
#include "behaviour.h"
#include "motion.h"
#include "targets.h"

#include <math.h>
#include <reach_status_t.h>

/* The target is virtual: the direction that its pixel has when it is presented, to which the head
 * then turns by its encoders. */
static void present(struct behaviour *behaviour, struct control *control, const double *target)
{
    const struct config *config = control->config;
    const double *q_head = control->q + config_arm_joints(config);
    double turn[VISUAL_DIMENSIONS];

    visual_to_task(config->pixels_per_radian, target, turn);
    for (int i = 0; i < HEAD_JOINTS; i++)
        behaviour->targets.head_goal[i] =
            fmin(fmax(q_head[i] + turn[i], config->head_min.value[i] + config->margin),
                 config->head_max.value[i] - config->margin);
}

/* Equation 13: the head's velocity fed forward, the marker's image error fed back. */
static void follow(struct control *control, double disparity)
{
    const struct config *config = control->config;
    const double *head_velocity = control->velocity + config_arm_joints(config);
    double error[VISUAL_DIMENSIONS] = {0, 0, disparity};
    double x_velocity[VISUAL_DIMENSIONS];

    for (int row = 0; row < VISUAL_DIMENSIONS; row++)
        error[row] -= control->sight->carried[row];
    visual_to_task(config->pixels_per_radian, error, x_velocity);
    for (int row = 0; row < VISUAL_DIMENSIONS; row++)
        x_velocity[row] *= config->follow_gain;
    for (int i = 0; i < HEAD_JOINTS; i++)
        x_velocity[i] += head_velocity[i];
    control_task_velocity(control, x_velocity);
}

static void turn_head(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    int n_arm = config_arm_joints(config);

    head_turn(config, control->q + n_arm, behaviour->targets.head_goal, control->velocity + n_arm);
    /* Shaped here, since the arm is to follow what the head really does. */
    motion_shape(config, n_arm, HEAD_JOINTS, control->q, control->previous, control->velocity);
}

static bool coordinate_step(struct behaviour *behaviour, struct control *control)
{
    const double *target;
    bool is_new;

    if (behaviour->progress.phase != REACH_STATUS_T_TRACK) {
        if (targets_prepare(behaviour, control))
            control_gather(control, control->config->fixation_frames);
        return true;
    }
    target = targets_current(behaviour, control, &is_new);
    if (!target)
        return false;
    if (is_new)
        present(behaviour, control, target);
    control->has_target = true;
    control->target[0] = control->target[1] = 0;
    control->target[2] = target[2];
    if (!sight_seen(control->sight, control->now)) {
        targets_refixate(behaviour);
        return true;
    }
    turn_head(behaviour, control);
    follow(control, target[2]);
    if (control->sight->new_frame && sight_centred(control->sight))
        control_gather(control, 1);
    return true;
}

const struct behaviour_ops behaviour_coordinate = {
    .name = "coordinate",
    .code = REACH_STATUS_T_COORDINATE,
    .start = targets_start,
    .step = coordinate_step,
};
