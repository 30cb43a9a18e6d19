/* What behaviours do in the same way. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_HELPERS_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_HELPERS_H

#include "daemon/control/behaviours/behaviour.h"

/* Whether a request's count is one of samples to collect. */
bool control_count_ok(const reach_request_t *request);

/* Position control of the arm towards `goal` (rad). Returns true when it is there. */
bool control_arm_to(const struct senses *senses, struct wants *wants, const double *goal);

/* The head follows the marker, or searches it. */
enum gaze_state control_gaze(const struct senses *senses, struct wants *wants, bool may_search);

/* Arm velocities for a wanted task velocity (rad/s, rad/s, px/s) by eq. 4; none without a model. */
void control_task_velocity(const struct senses *senses, struct wants *wants,
                           const double *x_velocity);

/* The same with the joints' null space drawn to `posture` (rad) at `gain` (K_s, rad/s) instead of
 * the middle of their range. */
void control_task_velocity_by(const struct senses *senses, struct wants *wants,
                              const double *x_velocity, const double *posture, double gain);

/* The same for any joints q (rad) and Jacobian, into velocity (rad/s). */
void control_joint_velocity(const struct config *config, const double *q, const double *jacobian,
                            const double *x_velocity, const double *posture, double gain,
                            double *velocity);

/* Feedback in terms of what is seen (eq. 5 and 13): `gain` (1/s) times what is left between the
 * marker and `target` (px), as a task velocity (rad/s, rad/s, px/s). `target` becomes this tick's
 * target. */
void control_approach(const struct senses *senses, struct wants *wants, const double *target,
                      double gain, double *x_velocity);

/* Makes the pair of the last n frames this tick's pair. */
void control_gather(const struct senses *senses, struct wants *wants, int n);

/* Middle of the babbled range, rad. */
void control_babble_centre(const struct config *config, double *goal);

#endif
