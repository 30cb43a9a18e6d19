#include "daemon/control/limits/motion.h"

#include <math.h>

static double clamp(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}

/* Scales all n velocities alike until each is within its joint's greatest. */
static void limit_velocity(const struct config *config, int first, int n, double *velocity)
{
    double share = 1;

    for (int i = first; i < first + n; i++) {
        double greatest = config_joint_limits(config, i).velocity;
        if (fabs(velocity[i]) > greatest)
            share = fmin(share, greatest / fabs(velocity[i]));
    }
    for (int i = first; i < first + n; i++)
        velocity[i] *= share;
}

void motion_range(const struct config *config, int joint, double q, double *down, double *up)
{
    struct joint_limits limits = config_joint_limits(config, joint);

    *down = fmin(config->motion_slow_down * (limits.min + config->motion_margin - q), 0);
    *up = fmax(config->motion_slow_down * (limits.max - config->motion_margin - q), 0);
}

void motion_shape(const struct config *config, int first, int n, const double *q,
                  const double *previous, double *velocity)
{
    limit_velocity(config, first, n, velocity);
    for (int i = first; i < first + n; i++) {
        struct joint_limits limits = config_joint_limits(config, i);
        double step = limits.acceleration * config->period;
        double down, up;
        motion_range(config, i, q[i], &down, &up);
        velocity[i] = clamp(velocity[i], previous[i] - step, previous[i] + step);
        velocity[i] = clamp(velocity[i], down, up);
    }
}
