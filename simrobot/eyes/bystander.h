/* Somebody who stands beside the robot and looks at it from both sides, for pictures of it. */
#ifndef SIMROBOT_EYES_BYSTANDER_H
#define SIMROBOT_EYES_BYSTANDER_H

#include "simrobot/world/simulation.h"

namespace sim
{

class Bystander
{
public:
    /* `half_view`: the tangent of half the angle of view. */
    explicit Bystander(double half_view) : half_view_(half_view) {}

    /* Puts the two eyes of the snapshot where they see all of the robot, one at each side of it,
     * the left one somewhat above. In later snapshots they stand still, and step back only where
     * the robot needs more room. */
    void look_on(Snapshot *snapshot);

private:
    double half_view_;
    double radius_ =
        0; /* of the ball about centre_ that is in view, m; 0 = nothing looked at yet */
    Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
};

} // namespace sim
#endif
