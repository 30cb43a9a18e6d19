/* Whether a robot's motors can hold its own weight. */
#ifndef SIMROBOT_WORLD_STRENGTH_H
#define SIMROBOT_WORLD_STRENGTH_H

#include "simrobot/world/rig.h"

namespace sim
{

/* Torque with which gravity turns each of `joints` (N m, or N where it slides), the ball in the
 * hand and no tool: what its motor must hold against is minus that. */
std::vector<double> gravity_torques(const Rig &rig, double ball_mass,
                                    const std::vector<double> &angles);

/* One line for each joint whose motor cannot hold the robot in a part of its range. */
std::vector<std::string> strength_notes(const Rig &rig, double ball_mass);

} // namespace sim
#endif
