#include "safety.h"

#include <math.h>
#include <string.h>

void safety_init(struct safety *safety, const struct config *config)
{
    memset(safety, 0, sizeof *safety);
    safety->config = config;
}

static double gate_joint(const struct safety *safety, int joint, double q, double velocity)
{
    const struct config *config = safety->config;
    struct joint_limits limits = config_joint_limits(config, joint);
    double step = limits.safety_acceleration * config->period;
    double previous = safety->previous[joint];

    if (!isfinite(velocity))
        velocity = 0;
    velocity = fmin(fmax(velocity, -limits.safety_velocity), limits.safety_velocity);
    velocity = fmin(fmax(velocity, previous - step), previous + step);
    /* Beyond a limit the joint may rest or come back, but is not driven back by force. */
    velocity = fmin(velocity, fmax(config->slow_down * (limits.max - q), 0));
    velocity = fmax(velocity, fmin(config->slow_down * (limits.min - q), 0));
    return velocity;
}

bool safety_gate(struct safety *safety, const double *q, double *velocity)
{
    bool changed = false;

    for (int i = 0; i < config_joints(safety->config); i++) {
        double allowed = gate_joint(safety, i, q[i], velocity[i]);
        /* A velocity that is not finite differs from every number. */
        changed = changed || !(allowed == velocity[i]);
        velocity[i] = allowed;
        safety->previous[i] = allowed;
    }
    safety->changed += changed;
    return changed;
}

void safety_brake(const struct config *config, double *velocity)
{
    for (int i = 0; i < config_joints(config); i++) {
        double step = config_joint_limits(config, i).safety_acceleration * config->period;
        velocity[i] = copysign(fmax(fabs(velocity[i]) - step, 0), velocity[i]);
    }
}

bool safety_at_rest(const double *velocity)
{
    for (int i = 0; i < MAX_JOINTS; i++)
        if (velocity[i] != 0)
            return false;
    return true;
}

void safety_was_braked(struct safety *safety, int braking_commands)
{
    for (int i = 0; i < braking_commands && !safety_at_rest(safety->previous); i++)
        safety_brake(safety->config, safety->previous);
}

void safety_rests(struct safety *safety)
{
    memset(safety->previous, 0, sizeof safety->previous);
}
