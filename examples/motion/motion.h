/* From the velocities that reachd commands to a motion that an arm's own controller takes:
 * positions and velocities that begin where the arm is, and change no faster than the arm can.
 *
 * A driver is the last before the motors, so that this trusts nobody: what is not finite or of
 * another number of joints is no command; what is too fast, too old, or would leave a joint's range
 * does not get through. All of it is one rule a joint: move as commanded, as fast as one can still
 * brake before the range ends, and before the set-point is farther from the arm than the leash. An
 * arm that is stopped at speed is overrun by no more than it takes to brake from that speed.
 *
 * Time is an argument. Allocates in motion_create alone. For one thread. */
#ifndef MOTION_H
#define MOTION_H

#include <stdbool.h>
#include <stdint.h>

enum {
    MOTION_JOINTS = 16,       /* at most, as in robot_command_t */
    MOTION_FRESH_US = 100000, /* so long a command counts */
    MOTION_GAP_US = 100000,   /* so long without a reading, and motion begins anew */
};

struct motion;

/* For so many joints, each with its range (rad), its fastest velocity (rad/s) and its acceleration
 * (rad/s^2), which are copied. `leash` (rad): how far the set-point may be from the arm, for each.
 * `period` (s): of the readings; when some are lost, what was missed is not caught up with, since
 * the drives would see a leap.
 *   returns NULL when a number is not finite, not positive where it must be, or memory is short */
struct motion *motion_create(int joints, const double *lowest, const double *highest,
                             const double *fastest, const double *acceleration, double leash,
                             double period);
void motion_destroy(struct motion *motion);

/* A command of `n` velocities (rad/s) has come at `now`, our clock, us. Returns false when it is
 * none: another number of joints, or not finite. */
bool motion_command(struct motion *motion, int n, const double *velocity, int64_t now);

/* The arm was read at `measured` (rad); `robot` is the robot's clock and `now` ours, us. A command
 * is obeyed while it is fresh by both: a robot whose clock runs ahead of ours (a simulator, states
 * that were held up) has no time to wait for ours. When the robot's clock goes back, or there was a
 * gap, the set-point begins anew where the arm is, at rest.
 *   set_point, set_velocity: the set-point as drives that are given velocities have it by now, rad
 *     and rad/s; NULL when they are given positions, and have what was returned last
 *   position, velocity: become the next set-point, rad and rad/s
 *   returns false when a reading is not finite; nothing may then be sent */
bool motion_step(struct motion *motion, const double *measured, const double *set_point,
                 const double *set_velocity, int64_t robot, int64_t now, double *position,
                 double *velocity);

/* The joint, from 1, whose set-point the leash holds back by now; 0 = none. */
int motion_leashed(const struct motion *motion);

#endif
