/* The robot as ODE bodies, joints and velocity-controlled motors. */
#ifndef SIMROBOT_WORLD_ROBOT_H
#define SIMROBOT_WORLD_ROBOT_H

#include "simrobot/world/joint.h"
#include "simrobot/world/rig.h"
#include "simrobot/world/world.h"

namespace sim
{

/* Joints are in the order of the messages (Rig::joints); those that follow one of them (<mimic>) go
 * with it. */
class Robot
{
public:
    /* `rig` and `world` must outlive the robot. */
    Robot(World &world, const Rig &rig, const Config &config);

    /* Puts all joints to `angles`, at rest, motors holding. */
    void reset(const std::vector<double> &angles);

    /* What the motors shall run at from now on, rad/s; limited to what URDF gives them. */
    void command(const std::vector<double> &velocities);

    /* Before each physics step: the drivers let the speed change only so fast. */
    void drive_motors();

    /* True joint angles and speeds, rad and rad/s. */
    std::vector<double> positions() const;
    std::vector<double> velocities() const;

    /* Poses of all segments in the base's frame. */
    std::vector<Eigen::Isometry3d> segment_poses() const;

    /* What of a segment others bump into. */
    std::vector<BodyShape> collisions(int segment) const;

    /* The body of a segment; nullptr for the base, which does not move. */
    dBodyID body(int segment) const
    {
        return bodies_[static_cast<size_t>(segment)];
    }

private:
    struct Motor {
        double acceleration; /* rad/s2 */
        double target;       /* rad/s, as commanded */
        double speed;        /* rad/s, what the motor is told at this step */
    };

    void add_segment(World &world, const Config &config, size_t index);
    double speed_of_follower(const Segment &segment, const Joint &follower) const;
    const Joint &joint(int segment) const
    {
        return joints_[static_cast<size_t>(segment) - 1];
    }

    const Rig &rig_;
    double step_;                 /* of physics, s */
    std::vector<dBodyID> bodies_; /* one a segment, owned by the world */
    std::vector<Joint> joints_;   /* that of segment i is at i - 1: the base has none */
    std::vector<Motor> motors_;
};

} // namespace sim
#endif
