/* The last gate before a command leaves: finite, joint range, velocity, acceleration.
 *
 * Whatever the code before it does, what passes here is safe for the robot. */
#ifndef REACH_SAFETY_H
#define REACH_SAFETY_H

#include "config.h"
#include "sizes.h"

#include <stdbool.h>
#include <stdint.h>

struct safety {
    const struct config *config;
    double previous[MAX_JOINTS]; /* last command that passed, rad/s */
    int64_t changed;             /* commands that had to be changed */
};

void safety_init(struct safety *safety, const struct config *config);

/* Gates the velocities (rad/s, in place) of all joints, which are at q (rad).
 * In this order, later ones winning: a velocity that is not finite becomes 0; at most the greatest
 * velocity; a change of at most the greatest acceleration; towards a joint limit at most
 * motion.slow_down times the distance to it. Returns true when something was changed. */
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
