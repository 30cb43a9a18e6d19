/* From what a behaviour wants to what the motors are asked: smooth, and away from the limits.
 *
 * This shapes wanted motion and is expected to act all the time; the safety gate behind it
 * (safety.h) has wider limits and is expected never to act. */
#ifndef REACH_DAEMON_CONTROL_LIMITS_MOTION_H
#define REACH_DAEMON_CONTROL_LIMITS_MOTION_H

#include "daemon/config/config.h"

/* How fast joint i of the command, at q (rad), may move either way for its limits' sake, rad/s. */
void motion_range(const struct config *config, int joint, double q, double *down, double *up);

/* Shapes velocities (rad/s, in place) of the joints first .. first + n - 1: the direction of the
 * wanted velocity is kept while it is scaled into the greatest velocity; near a joint limit it is
 * slowed down; its change since `previous` is bounded by the greatest acceleration.
 * `q` and `previous` are indexed like `velocity`, by joint of the command. */
void motion_shape(const struct config *config, int first, int n, const double *q,
                  const double *previous, double *velocity);

#endif
