#include "simrobot/world/robot.h"

#include <algorithm>
#include <cmath>

namespace sim
{

Robot::Robot(World &world, const Rig &rig, const Config &config)
    : rig_(rig), step_(world.step_length())
{
    size_t n = rig.description.segments.size();

    bodies_.assign(n, nullptr);
    motors_.assign(n, Motor{config.head_acceleration, 0, 0});
    for (int i = 0; i < rig.n_arm; i++)
        motors_[static_cast<size_t>(rig.joints[static_cast<size_t>(i)])].acceleration =
            config.arm_acceleration;
    for (size_t i = 1; i < n; i++)
        add_segment(world, config, i);
}

/* Body and joint are made at angle 0, which is where ODE then measures the angle from. */
void Robot::add_segment(World &world, const Config &config, size_t index)
{
    const Segment &segment = rig_.description.segments[index];
    Eigen::Isometry3d frame =
        rig_poses(rig_, std::vector<double>(rig_.description.segments.size(), 0.0))[index];
    dBodyID body = dBodyCreate(world.id());

    body_set_mass(body, segment.mass, segment.inertia);
    body_set_pose(body, frame * Eigen::Translation3d(segment.centre_of_mass));
    bodies_[index] = body;
    joints_.emplace_back(world, segment, frame, body, bodies_[static_cast<size_t>(segment.parent)],
                         config.hard_stops);
}

void Robot::reset(const std::vector<double> &angles)
{
    std::vector<double> positions = rig_positions(rig_, angles);
    std::vector<Eigen::Isometry3d> poses = rig_poses(rig_, positions);

    for (size_t i = 1; i < bodies_.size(); i++) {
        const Segment &segment = rig_.description.segments[i];
        body_set_pose(bodies_[i], poses[i] * Eigen::Translation3d(segment.centre_of_mass));
        dBodySetLinearVel(bodies_[i], 0, 0, 0);
        dBodySetAngularVel(bodies_[i], 0, 0, 0);
        motors_[i].target = motors_[i].speed = 0;
        joints_[i - 1].put(positions[i]);
    }
}

void Robot::command(const std::vector<double> &velocities)
{
    for (size_t i = 0; i < rig_.joints.size(); i++) {
        auto segment = static_cast<size_t>(rig_.joints[i]);
        double limit = rig_.description.segments[segment].velocity;
        motors_[segment].target = std::clamp(velocities[i], -limit, limit);
    }
}

void Robot::drive_motors()
{
    for (size_t i = 1; i < motors_.size(); i++) {
        double most = motors_[i].acceleration * step_;
        if (rig_.description.segments[i].leader >= 0)
            motors_[i].speed = speed_of_follower(rig_.description.segments[i], joints_[i - 1]);
        else
            motors_[i].speed += std::clamp(motors_[i].target - motors_[i].speed, -most, most);
        joints_[i - 1].drive(motors_[i].speed);
    }
}

/* As a gear from its leader; what it has fallen behind is caught up within some steps. */
double Robot::speed_of_follower(const Segment &segment, const Joint &follower) const
{
    const double share = 0.2; /* as much as ODE takes back of other joints' errors */
    const Joint &leader = joint(segment.leader);
    double behind = segment.multiplier * leader.position() + segment.offset - follower.position();

    return segment.multiplier * leader.velocity() + share * behind / step_;
}

std::vector<double> Robot::positions() const
{
    std::vector<double> result;
    for (int segment : rig_.joints)
        result.push_back(joint(segment).position());
    return result;
}

std::vector<double> Robot::velocities() const
{
    std::vector<double> result;
    for (int segment : rig_.joints)
        result.push_back(joint(segment).velocity());
    return result;
}

std::vector<Eigen::Isometry3d> Robot::segment_poses() const
{
    std::vector<Eigen::Isometry3d> poses(bodies_.size(), Eigen::Isometry3d::Identity());
    for (size_t i = 1; i < bodies_.size(); i++) {
        Eigen::Vector3d centre = rig_.description.segments[i].centre_of_mass;
        poses[i] = body_pose(bodies_[i]) * Eigen::Translation3d(-centre);
    }
    return poses;
}

std::vector<BodyShape> Robot::collisions(int segment) const
{
    const Segment &description = rig_.description.segments[static_cast<size_t>(segment)];
    std::vector<BodyShape> result;

    for (Shape shape : description.collisions) {
        shape.pose = Eigen::Translation3d(-description.centre_of_mass) * shape.pose;
        result.push_back({body(segment), shape});
    }
    return result;
}

} // namespace sim
