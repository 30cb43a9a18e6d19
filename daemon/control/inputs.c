#include "daemon/control/inputs.h"

#include "daemon/config/sizes.h"

#include <math.h>

static const double range_slack = 0.35;     /* rad; an encoder may read a little beyond a stop */
static const double velocity_most = 100;    /* rad/s; nothing on a robot turns faster */
static const double period_most = 3600;     /* s */
static const int32_t count_most = 10000000; /* samples of one request */
static const int32_t model_number_most = 9999;

bool inputs_state_ok(const struct config *config, const reach_robot_state_t *state)
{
    if (state->n_joints != config_joints(config) || state->utime <= 0 || state->seq <= 0)
        return false;
    for (int i = 0; i < state->n_joints; i++) {
        struct joint_limits limits = config_joint_limits(config, i);
        /* Written so that a NaN fails. */
        if (!(state->position[i] >= limits.min - range_slack &&
              state->position[i] <= limits.max + range_slack) ||
            !(fabs(state->velocity[i]) <= velocity_most))
            return false;
    }
    return true;
}

static bool sensible(const struct config *config, const double value[SPACE_DIMENSIONS])
{
    /* Written so that a NaN fails. */
    for (int axis = 0; axis < SPACE_DIMENSIONS; axis++)
        if (!(fabs(value[axis]) <= config->space.largest))
            return false;
    return true;
}

bool inputs_observation_ok(const struct config *config, const struct observation *observation)
{
    return observation->utime > 0 && sensible(config, observation->value);
}

static bool targets_ok(const struct config *config, const reach_request_t *request)
{
    if (request->n_targets < 1 || request->n_targets > MAX_TARGETS ||
        !(request->period > 0 && request->period <= period_most))
        return false;
    for (int i = 0; i < request->n_targets; i++)
        if (!sensible(config, request->target[i]))
            return false;
    return request->count == 0 || request->count == 1;
}

bool inputs_request_ok(const struct config *config, const reach_request_t *request)
{
    switch (request->kind) {
    case REACH_REQUEST_T_STOP:
    case REACH_REQUEST_T_RESET_FAULT:
    case REACH_REQUEST_T_EMERGENCY:
        return true;
    case REACH_REQUEST_T_BABBLE:
    case REACH_REQUEST_T_EXPLORE:
        return request->count >= 1 && request->count <= count_most;
    case REACH_REQUEST_T_COORDINATE:
        return config->space.n_head > 0 && targets_ok(config, request);
    case REACH_REQUEST_T_REACH:
        return targets_ok(config, request);
    case REACH_REQUEST_T_SAVE:
    case REACH_REQUEST_T_LOAD:
        return request->count >= 0 && request->count <= model_number_most;
    default:
        return false;
    }
}
