/* One driven joint of the robot in ODE: what holds two bodies together, its motor, and its stops.
 */
#ifndef SIMROBOT_WORLD_JOINT_H
#define SIMROBOT_WORLD_JOINT_H

#include "simrobot/world/world.h"

namespace sim
{

/* Motor and stop are joints of their own, because ODE throws a joint on which both sit: at the stop
 * it turns the motor's whole torque into a push. The stop goes by the counted angle, because ODE
 * knows an angle within one turn only. */
class Joint
{
public:
    /* `frame`: the segment's, in which both bodies stand now, at angle 0. The world owns what is
     * made here; `parent` nullptr: the base, which stands still. */
    Joint(World &world, const Segment &segment, const Eigen::Isometry3d &frame, dBodyID body,
          dBodyID parent, bool has_stops);

    /* The bodies were put where the joint is at `position` (rad). */
    void put(double position)
    {
        last_ = position;
    }

    /* Before each step of the physics: the speed that the motor is to hold, rad/s. */
    void drive(double speed);

    /* rad, turns counted, as long as a step turns it by less than half a turn; rad/s. */
    double position() const;
    double velocity() const;

private:
    void add_stop(World &world, const Segment &segment, const Eigen::Vector3d &axis, dBodyID body,
                  dBodyID parent);

    dJointID hinge_;
    dJointID stop_ = nullptr;
    double last_ = 0; /* position at the last step */
};

} // namespace sim
#endif
