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

#endif
