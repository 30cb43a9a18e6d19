/* Task-space control: joint velocities for a wanted task velocity (paper section 4, eq. 4-9). */
#ifndef REACH_DAEMON_CONTROL_KINEMATICS_TASKSPACE_H
#define REACH_DAEMON_CONTROL_KINEMATICS_TASKSPACE_H

#include "daemon/config/sizes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How to invert. Task rows are divided by `scale` first, so that rows of different units share
 * one threshold and one damping. */
struct taskspace {
    int n_joints;               /* columns of J, 1 .. MAX_JOINTS */
    int n_outputs;              /* rows of J, 1 .. MAX_OUTPUTS */
    double scale[MAX_OUTPUTS];  /* task units that count as one, > 0 */
    double threshold;           /* delta_T of eq. 9, scaled task units per rad */
    double damping_max;         /* lambda_MAX of eq. 9, same unit */
    double secondary_gain;      /* K_s of eq. 4, rad/s for a gradient of 1/rad */
    double slowest[MAX_JOINTS]; /* least velocity that a joint may have, rad/s, <= 0 */
    double fastest[MAX_JOINTS]; /* greatest, >= 0 */
    double q_min[MAX_JOINTS];   /* rad */
    double q_max[MAX_JOINTS];   /* rad */
    double posture[MAX_JOINTS]; /* where M(q) is least, rad; eq. 6: the middle of the range */
};

/* Joint velocities (rad/s) for the task velocity `x_velocity` (task units/s) at joints q (rad)
 * under the Jacobian (n_outputs x n_joints, row-major). K_m is already part of x_velocity.
 * A joint that would leave `slowest` .. `fastest`, because it is near its limit, gets the bound,
 * and the others make up for what it does not do: without that an arm stops short of places that it
 * can reach otherwise. Returns the smallest singular value of the scaled Jacobian of all joints.
 * All input must be finite. */
double taskspace_velocity(const struct taskspace *taskspace, const double *jacobian,
                          const double *x_velocity, const double *q, double *q_velocity);

/* Gradient of M(q), eq. 6 and 7: pulls every joint to `posture`. 1/rad. */
void taskspace_centring_gradient(const struct taskspace *taskspace, const double *q,
                                 double *gradient);

#ifdef __cplusplus
}
#endif
#endif
