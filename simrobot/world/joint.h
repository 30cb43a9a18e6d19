/* One driven joint of the robot in ODE: what holds two bodies together, its motor, and its stops.
 */
#ifndef SIMROBOT_WORLD_JOINT_H
#define SIMROBOT_WORLD_JOINT_H

#include "simrobot/world/world.h"

namespace sim
{

/* Turns, or slides, in which case angles are metres here, and torques newtons. Motor and stop are
 * joints of their own, because ODE throws a joint on which both sit: at the stop it turns the
 * motor's whole torque into a push. */
class Joint
{
public:
    /* `frame`: the segment's, in which both bodies stand now, at angle 0. The world owns what is
     * made here; `parent` nullptr: the base, which stands still. An endless effort makes a gear of
     * the motor: what it is told to do it does. */
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
    void make_hinge(World &world, const Segment &segment, const Eigen::Vector3d &anchor);
    void make_slider(World &world, const Segment &segment);
    void make_angle_stop(World &world);
    void set_stop(double step, const Segment &segment);

    Eigen::Vector3d axis_;
    dBodyID body_, parent_;
    bool slides_;
    dJointID joint_ = nullptr; /* hinge or slider */
    dJointID motor_ = nullptr; /* a slider's: a hinge has its own */
    dJointID stop_ = nullptr;  /* a hinge's, if it has any: a slider has its own */
    double last_ = 0;          /* position at the last step */
};

} // namespace sim
#endif
