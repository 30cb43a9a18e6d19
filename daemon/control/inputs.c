#include "daemon/control/inputs.h"

#include <math.h>

static const double range_slack = 0.35;  /* rad; an encoder may read a little beyond a stop */
static const double velocity_most = 100; /* rad/s; nothing on a robot turns faster */
static const int32_t model_number_most = 9999;

/* Written so that a NaN fails. */
static bool is_within(double value, double min, double max, int joint, struct state_fault *fault)
{
    *fault = (struct state_fault){joint + 1, value, min, max};
    return value >= min && value <= max;
}

bool inputs_state_ok(const struct config *config, const reach_robot_state_t *state,
                     struct state_fault *fault)
{
    *fault = (struct state_fault){0};
    if (state->n_joints != config_joints(config) || state->utime <= 0 || state->seq <= 0)
        return false;
    for (int i = 0; i < state->n_joints; i++) {
        struct joint_limits limits = config_joint_limits(config, i);
        if (!is_within(state->position[i], limits.min - range_slack, limits.max + range_slack, i,
                       fault) ||
            !is_within(state->velocity[i], -velocity_most, velocity_most, i, fault))
            return false;
    }
    return true;
}

bool inputs_observation_ok(const struct config *config, const struct observation *observation)
{
    return observation->utime > 0 && observation_is_sensible(&config->space, observation->value);
}

bool inputs_request_ok(const reach_request_t *request)
{
    switch (request->kind) {
    case REACH_REQUEST_T_STOP:
    case REACH_REQUEST_T_RESET_FAULT:
    case REACH_REQUEST_T_EMERGENCY:
    case REACH_REQUEST_T_TELL_BODY:
    case REACH_REQUEST_T_FORGET_BODY:
        return true;
    case REACH_REQUEST_T_SAVE:
    case REACH_REQUEST_T_LOAD:
        return request->count >= 0 && request->count <= model_number_most;
    default:
        return false;
    }
}
