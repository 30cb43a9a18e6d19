/* Arm-head coordination (paper section 7.2): the head turns to targets, the arm keeps the marker
 * in fixation. */
#include "daemon/control/behaviours/behaviour.h"
#include "daemon/control/behaviours/targets.h"
#include "daemon/control/limits/motion.h"

#include <math.h>
#include <reach_status_t.h>
#include <string.h>

/* The target is virtual: the direction that its pixel has when it is presented, to which the head
 * then turns by its encoders. */
static void present(struct behaviour *behaviour, struct control *control, const double *target)
{
    const struct config *config = control->config;
    const double *q_head = control->q + config_arm_joints(config);
    double turn[SPACE_DIMENSIONS];

    space_to_task(&config->space, target, turn);
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
    const double centre[SPACE_DIMENSIONS] = {0, 0, disparity};
    double x_velocity[SPACE_DIMENSIONS];

    control_approach(control, centre, config->follow_gain, x_velocity);
    for (int i = 0; i < HEAD_JOINTS; i++)
        x_velocity[i] += head_velocity[i];
    control_task_velocity(control, x_velocity);
}

static void turn_head(struct behaviour *behaviour, struct control *control)
{
    const struct config *config = control->config;
    struct targets *targets = &behaviour->targets;
    int n_arm = config_arm_joints(config);

    targets_slide(config->period, config->head_smoothing, targets->head_goal, targets->setpoint,
                  HEAD_JOINTS);
    head_turn(config, control->q + n_arm, targets->setpoint, control->velocity + n_arm);
    /* Shaped here, since the arm is to follow what the head really does. */
    motion_shape(config, n_arm, HEAD_JOINTS, control->q, control->previous, control->velocity);
}

static bool coordinate_step(struct behaviour *behaviour, struct control *control)
{
    const double *target = NULL;

    switch (targets_step(behaviour, control, &target)) {
    case TARGETS_PREPARE:
        memcpy(behaviour->targets.setpoint, control->q + config_arm_joints(control->config),
               HEAD_JOINTS * sizeof(double));
        return true;
    case TARGETS_DONE:
        return false;
    case TARGETS_PRESENT:
        present(behaviour, control, target);
        break;
    case TARGETS_PURSUE:
        break;
    }
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
