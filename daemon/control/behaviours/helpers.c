#include "daemon/control/behaviours/helpers.h"

#include "daemon/control/kinematics/taskspace.h"
#include "daemon/control/limits/motion.h"

#include <math.h>
#include <string.h>

static const int32_t count_most = 10000000; /* samples of one request */

bool control_count_ok(const reach_request_t *request)
{
    return request->count >= 1 && request->count <= count_most;
}

bool control_arm_to(const struct senses *senses, struct wants *wants, const double *goal)
{
    bool there = true;

    for (int i = 0; i < config_arm_joints(senses->config); i++) {
        double error = goal[i] - senses->q[i];
        wants->velocity[i] = senses->config->babble_gain * error;
        there = there && fabs(error) <= senses->config->babble_tolerance;
    }
    return there;
}

enum gaze_state control_gaze(const struct senses *senses, struct wants *wants, bool may_search)
{
    int n_arm = config_arm_joints(senses->config);

    if (senses->config->space.n_head == 0)
        return sight_seen(senses->sight, senses->now) ? GAZE_ON_MARKER : GAZE_WAITING;
    return gaze_step(wants->gaze, senses->sight, senses->now, senses->time, senses->q + n_arm,
                     may_search, wants->velocity + n_arm);
}

void control_task_velocity(const struct senses *senses, struct wants *wants,
                           const double *x_velocity)
{
    const struct config *config = senses->config;
    double middle[MAX_JOINTS];

    for (int i = 0; i < config_arm_joints(config); i++)
        middle[i] = 0.5 * (config->arm_min.value[i] + config->arm_max.value[i]);
    control_task_velocity_by(senses, wants, x_velocity, middle, config->task_secondary_gain);
}

void control_task_velocity_by(const struct senses *senses, struct wants *wants,
                              const double *x_velocity, const double *posture, double gain)
{
    const double *jacobian = estimate_jacobian(senses->estimate);

    if (jacobian)
        control_joint_velocity(senses->config, senses->q, jacobian, x_velocity, posture, gain,
                               wants->velocity);
}

void control_joint_velocity(const struct config *config, const double *q, const double *jacobian,
                            const double *x_velocity, const double *posture, double gain,
                            double *velocity)
{
    struct taskspace taskspace = {
        .n_joints = config_arm_joints(config),
        .n_outputs = SPACE_DIMENSIONS,
        .threshold = config->task_singular_threshold,
        .damping_max = config->task_damping_max,
        .secondary_gain = gain,
    };

    memcpy(taskspace.scale, config->space.scale, sizeof config->space.scale);
    memcpy(taskspace.posture, posture, sizeof(double) * (size_t)taskspace.n_joints);
    memcpy(taskspace.q_min, config->arm_min.value, sizeof taskspace.q_min);
    memcpy(taskspace.q_max, config->arm_max.value, sizeof taskspace.q_max);
    for (int i = 0; i < taskspace.n_joints; i++)
        motion_range(config, i, q[i], &taskspace.slowest[i], &taskspace.fastest[i]);
    taskspace_velocity(&taskspace, jacobian, x_velocity, q, velocity);
}

void control_approach(const struct senses *senses, struct wants *wants, const double *target,
                      double gain, double *x_velocity)
{
    double error[SPACE_DIMENSIONS];

    memcpy(wants->target, target, sizeof wants->target);
    wants->has_target = true;
    for (int row = 0; row < SPACE_DIMENSIONS; row++)
        error[row] = gain * (target[row] - senses->sight->carried[row]);
    space_to_task(&senses->config->space, error, x_velocity);
}

void control_gather(const struct senses *senses, struct wants *wants, int n)
{
    sight_pair(senses->sight, n, wants->pair.q, wants->pair.x, &wants->pair.utime);
    wants->has_pair = true;
}

void control_babble_centre(const struct config *config, double *goal)
{
    for (int i = 0; i < config_arm_joints(config); i++)
        goal[i] = 0.5 * (config->babble_min.value[i] + config->babble_max.value[i]);
}
