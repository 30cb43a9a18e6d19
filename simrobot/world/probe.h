/* What the simulator makes of a robot, in numbers that others can check: where the hand is, what
 * gravity does, and whether a robot that swings freely keeps its energy. */
#ifndef SIMROBOT_WORLD_PROBE_H
#define SIMROBOT_WORLD_PROBE_H

#include <cstdio>

#include "simrobot/world/rig.h"

namespace sim
{

/* A line of JSON for each of `count` random postures within the limits: "position" of the joints
 * (rad, m), "place" of the hand in the base's frame (m), "gravity": what gravity does about each
 * joint (N m, N), ball included. */
void probe_postures(const Config &config, const Rig &rig, uint64_t seed, int64_t count, FILE *out);

/* A line of JSON on how a robot moves for `seconds` with its motors and stops off, from a random
 * posture at rest: "kinetic", the most that it had, and "drift", the most by which the sum of
 * kinetic and potential energy left where it began (J). */
void probe_swing(const Config &config, const Rig &rig, uint64_t seed, double seconds, FILE *out);

/* A line of JSON on how fast the joints get for `seconds` of random commands up to their limit
 * speeds, motors and stops on: "fastest", the greatest speed of one over its limit, and "joint",
 * its name. */
void probe_speeds(const Config &config, const Rig &rig, uint64_t seed, double seconds, FILE *out);

} // namespace sim
#endif
