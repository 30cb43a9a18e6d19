#include "daemon/control/behaviours/behaviour.h"

#include "daemon/control/kinematics/taskspace.h"
#include "daemon/control/limits/motion.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

const struct behaviour_ops *behaviour_for_request(int8_t kind)
{
    switch (kind) {
    case REACH_REQUEST_T_BABBLE:
        return &behaviour_babble;
    case REACH_REQUEST_T_COORDINATE:
        return &behaviour_coordinate;
    case REACH_REQUEST_T_EXPLORE:
        return &behaviour_explore;
    case REACH_REQUEST_T_REACH:
        return &behaviour_reach;
    default:
        return NULL;
    }
}

bool control_arm_to(struct control *control, const double *goal)
{
    bool there = true;

    for (int i = 0; i < config_arm_joints(control->config); i++) {
        double error = goal[i] - control->q[i];
        control->velocity[i] = control->config->babble_gain * error;
        there = there && fabs(error) <= control->config->babble_tolerance;
    }
    return there;
}

enum gaze_state control_gaze(struct control *control, bool may_search)
{
    int n_arm = config_arm_joints(control->config);

    if (control->config->space.n_head == 0)
        return sight_seen(control->sight, control->now) ? GAZE_ON_MARKER : GAZE_WAITING;
    return gaze_step(control->gaze, control->sight, control->now, control->q + n_arm, may_search,
                     control->velocity + n_arm);
}

void control_task_velocity(struct control *control, const double *x_velocity)
{
    const struct config *config = control->config;
    double middle[MAX_JOINTS];

    for (int i = 0; i < config_arm_joints(config); i++)
        middle[i] = 0.5 * (config->arm_min.value[i] + config->arm_max.value[i]);
    control_task_velocity_by(control, x_velocity, middle, config->secondary_gain);
}

void control_task_velocity_by(struct control *control, const double *x_velocity,
                              const double *posture, double gain)
{
    const struct config *config = control->config;
    const double *jacobian = estimate_jacobian(control->estimate);
    struct taskspace taskspace = {
        .n_joints = config_arm_joints(config),
        .n_outputs = SPACE_DIMENSIONS,
        .threshold = config->singular_threshold,
        .damping_max = config->damping_max,
        .secondary_gain = gain,
    };

    if (!jacobian)
        return;
    memcpy(taskspace.scale, config->space.scale, sizeof config->space.scale);
    memcpy(taskspace.posture, posture, sizeof(double) * (size_t)taskspace.n_joints);
    memcpy(taskspace.q_min, config->arm_min.value, sizeof taskspace.q_min);
    memcpy(taskspace.q_max, config->arm_max.value, sizeof taskspace.q_max);
    for (int i = 0; i < taskspace.n_joints; i++)
        motion_range(config, i, control->q[i], &taskspace.slowest[i], &taskspace.fastest[i]);
    taskspace_velocity(&taskspace, jacobian, x_velocity, control->q, control->velocity);
}

void control_approach(struct control *control, const double *target, double gain,
                      double *x_velocity)
{
    double error[SPACE_DIMENSIONS];

    memcpy(control->target, target, sizeof control->target);
    control->has_target = true;
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        error[row] = gain * (target[row] - control->sight->carried[row]);
    space_to_task(&control->config->space, error, x_velocity);
}

void control_gather(struct control *control, int n)
{
    sight_pair(control->sight, n, control->pair.q, control->pair.x, &control->pair.utime);
    control->has_pair = true;
}

void control_babble_centre(const struct config *config, double *goal)
{
    for (int i = 0; i < config_arm_joints(config); i++)
        goal[i] = 0.5 * (config->babble_min.value[i] + config->babble_max.value[i]);
}
