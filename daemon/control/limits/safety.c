#include "daemon/control/limits/safety.h"

#include <math.h>
#include <string.h>

void safety_init(struct safety *safety, const struct config *config)
{
    memset(safety, 0, sizeof *safety);
    safety->config = config;
}

/* The last command, in force for so many periods. */
static void hold_command(struct safety *safety, double periods)
{
    safety->newest = (safety->newest + 1) % SAFETY_RECENT;
    safety->since += safety->since < SAFETY_RECENT;
    for (int i = 0; i < config_joints(safety->config); i++)
        safety->way[safety->newest][i] = safety->previous[i] * safety->config->period * periods;
}

/* Commanded k periods ago, as far as it goes into the direction `sign`. */
static double way(const struct safety *safety, int joint, double sign, int k)
{
    return fmax(sign * safety->way[(safety->newest + SAFETY_RECENT - k) % SAFETY_RECENT][joint], 0);
}

void safety_measured(struct safety *safety)
{
    safety->since = 0;
}

void safety_held(struct safety *safety, int64_t periods)
{
    if (periods > 0)
        hold_command(safety, (double)periods);
}

/* The greatest v for which v hold + v^2 / (2 acceleration) is at most `room`: held for so long,
 * then braked. 0 where there is no room. */
static double stoppable(double room, double hold, double acceleration)
{
    if (room <= 0)
        return 0;
    return acceleration * (sqrt(hold * hold + 2 * room / acceleration) - hold);
}

/* The greatest velocity into the direction `sign`, in which `room` is left to the limit. */
static double allowed(const struct safety *safety, int joint, double sign, double room)
{
    const struct config *config = safety->config;
    double most = config_joint_limits(config, joint).safety_acceleration;
    int late = (int)ceil(config->safety_latency / config->period - 1e-9) + 1;
    double fastest = 0;

    if (safety->since + late > SAFETY_RECENT)
        return 0; /* not measured for long */
    for (int k = 0; k < safety->since; k++)
        room -= way(safety, joint, sign, k);
    for (int k = 0; k < safety->since + late; k++)
        fastest = fmax(fastest, way(safety, joint, sign, k));
    return fmin(stoppable(room - late * fastest, config->period + config->safety_latency, most),
                stoppable(room - way(safety, joint, sign, safety->since),
                          config->period + config->safety_reaction, most));
}

static double gate_joint(const struct safety *safety, int joint, double q, double velocity)
{
    struct joint_limits limits = config_joint_limits(safety->config, joint);
    double step = limits.safety_acceleration * safety->config->period;
    double previous = safety->previous[joint];

    if (!isfinite(velocity))
        velocity = 0;
    velocity = fmin(fmax(velocity, -limits.safety_velocity), limits.safety_velocity);
    /* Beyond a limit the joint may rest or come back, but is not driven back by force. */
    velocity = fmin(velocity, allowed(safety, joint, 1, limits.max - q));
    velocity = fmax(velocity, -allowed(safety, joint, -1, q - limits.min));
    return fmin(fmax(velocity, previous - step), previous + step);
}

bool safety_gate(struct safety *safety, const double *q, double *velocity)
{
    bool changed = false;

    for (int i = 0; i < config_joints(safety->config); i++) {
        double gated = gate_joint(safety, i, q[i], velocity[i]);
        /* A velocity that is not finite differs from every number. */
        changed = changed || !(gated == velocity[i]);
        velocity[i] = gated;
        safety->previous[i] = gated;
    }
    hold_command(safety, 1);
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
    for (int i = 0; i < braking_commands && !safety_at_rest(safety->previous); i++) {
        safety_brake(safety->config, safety->previous);
        hold_command(safety, 1);
    }
}

void safety_rests(struct safety *safety)
{
    memset(safety->previous, 0, sizeof safety->previous);
}
