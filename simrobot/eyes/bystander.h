/* Where somebody stands who looks at a robot without eyes, for a picture of it. */
#ifndef SIMROBOT_EYES_BYSTANDER_H
#define SIMROBOT_EYES_BYSTANDER_H

#include "simrobot/world/simulation.h"

namespace sim
{

/* Puts the two eyes of the snapshot where they see all of the robot, one at each side of it, the
 * left one somewhat above. `half_view` is the tangent of half the angle of view. */
void bystander_look_on(double half_view, Snapshot *snapshot);

} // namespace sim
#endif
