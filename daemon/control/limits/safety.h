/* The last gate before a command leaves: finite, joint range, velocity, acceleration.
 *
 * Whatever the code before it does, what passes here is safe for the robot. A joint never moves so
 * fast towards its limit that it could not be stopped before it with the greatest acceleration, in
 * two cases:
 *   late   the joint was measured, and obeys, later than a period by safety.latency together, in
 *          which it may go on with the fastest of the latest commands
 *   still  the command that leaves now holds for safety.reaction before another follows (the loop
 *          stands still until the watchdog acts)
 * Position, velocity and acceleration are kept at once: a command that could be stopped in time
 * one period ago, at the greatest acceleration, can be followed by one that is slower by as
 * much as this acceleration allows (tests/unit/control/test_safety.c, test_limits.c). */
#ifndef REACH_DAEMON_CONTROL_LIMITS_SAFETY_H
#define REACH_DAEMON_CONTROL_LIMITS_SAFETY_H

#include "daemon/config/config.h"
#include "daemon/config/sizes.h"

#include <stdbool.h>
#include <stdint.h>

struct safety {
    const struct config *config;
    double previous[MAX_JOINTS];           /* last command that passed, rad/s */
    double way[SAFETY_RECENT][MAX_JOINTS]; /* commanded in the latest periods, a ring, rad */
    int newest;                            /* index into it */
    int since;                             /* periods since the joints were measured */
    int64_t changed;                       /* commands that had to be changed */
};

void safety_init(struct safety *safety, const struct config *config);

/* The joints have just been measured. */
void safety_measured(struct safety *safety);

/* The last command stayed in force for so many periods more than one. */
void safety_held(struct safety *safety, int64_t periods);

/* Gates the velocities (rad/s, in place) of all joints, which were measured at q (rad).
 * In this order, later ones winning: a velocity that is not finite becomes 0; at most the greatest
 * velocity; towards a joint limit what can be stopped before it; a change of at most the greatest
 * acceleration. Returns true when something was changed. */
bool safety_gate(struct safety *safety, const double *q, double *velocity);

/* What brakes without the gate: each velocity nearer to zero by as much as the greatest
 * acceleration allows in a period. */
void safety_brake(const struct config *config, double *velocity);

bool safety_at_rest(const double *velocity);

/* Others sent `braking_commands` of safety_brake after the last command that passed here. */
void safety_was_braked(struct safety *safety, int braking_commands);

/* No command has gone out for so long that the robot has stopped by itself. */
void safety_rests(struct safety *safety);

#endif
