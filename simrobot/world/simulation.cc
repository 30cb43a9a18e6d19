#include "simrobot/world/simulation.h"

#include <cmath>

#include "simrobot/world/visibility.h"

namespace sim
{

Simulation::Simulation(const Config &config, const Rig &rig, uint64_t seed)
    : config_(config), rig_(rig), world_(config.physics_step * 1e-3), robot_(world_, rig, config),
      light_(config, seed), mounts_(config, seed), encoder_random_(seed, 1),
      effector_random_(seed, 8)
{
    robot_.reset(rig.start);
    if (config.collisions)
        contacts_ = std::make_unique<Contacts>(world_, rig, robot_);
    make_tool();
}

void Simulation::reset()
{
    robot_.reset(rig_.start);
    make_tool();
}

void Simulation::make_tool()
{
    const ToolConfig *chosen = tool_index_ ? &config_.tools[tool_index_ - 1] : nullptr;
    Eigen::Isometry3d hand = rig_link(rig_.hand, robot_.segment_poses());

    tool_.reset();
    tool_ = std::make_unique<Tool>(world_, robot_.body(rig_.hand.segment), hand, config_, chosen);
    if (contacts_)
        contacts_->take_tool(*tool_);
}

bool Simulation::set_tool(int tool)
{
    if (tool < 0 || tool > max_tools)
        return false;
    if (tool > 0 && config_.tools[tool - 1].kind == static_cast<int>(ToolKind::none))
        return false;
    tool_index_ = tool;
    make_tool();
    return true;
}

void Simulation::command(const std::vector<double> &velocities)
{
    robot_.command(velocities);
}

void Simulation::step()
{
    robot_.drive_motors();
    if (contacts_)
        contacts_->find();
    world_.step();
    steps_++;
    touching_steps_ += contacts_ && contacts_->touching();
}

double Simulation::reading_error()
{
    if (config_.encoder_noise_kind == static_cast<int>(NoiseKind::uniform))
        return encoder_random_.uniform(-1, 1);
    return encoder_random_.gaussian();
}

Reading Simulation::read_encoders()
{
    Reading reading = {robot_.positions(), robot_.velocities()};

    for (double &position : reading.position)
        position += config_.encoder_noise * reading_error();
    for (double &velocity : reading.velocity)
        velocity += config_.encoder_velocity_noise * reading_error();
    return reading;
}

Eigen::Vector3d Simulation::measure_effector()
{
    Eigen::Vector3d position = tool_->ball();

    for (double &coordinate : position)
        coordinate += config_.effector_noise * effector_random_.gaussian();
    return position;
}

std::vector<Shape> Simulation::shapes(const std::vector<Eigen::Isometry3d> &poses) const
{
    std::vector<Shape> result;

    for (size_t i = 0; i < poses.size(); i++)
        for (Shape shape : rig_.description.segments[i].shapes) {
            shape.pose = poses[i] * shape.pose;
            result.push_back(shape);
        }
    tool_->append_shapes(&result);
    return result;
}

Snapshot Simulation::snapshot(int64_t number) const
{
    std::vector<Eigen::Isometry3d> poses = robot_.segment_poses();
    double seconds = static_cast<double>(elapsed()) * 1e-6;
    MountTurns turns = mounts_.at(seconds, number);

    return {number,
            shapes(poses),
            tool_->ball(),
            config_.ball_radius,
            rig_link(rig_.left_eye, poses) * turns.left,
            rig_link(rig_.right_eye, poses) * turns.right,
            light_.at(seconds, number, brightness_)};
}

Truth Simulation::truth() const
{
    std::vector<Eigen::Isometry3d> poses = robot_.segment_poses();
    Truth truth = {};

    truth.position = robot_.positions();
    truth.velocity = robot_.velocities();
    truth.ball = tool_->ball();
    truth.ball_speed = tool_->ball_velocity().norm();
    truth.visible = -1;
    truth.touching = contacts_ ? contacts_->touching() : 0;
    truth.deepest = contacts_ ? contacts_->depth() : 0;
    if (!rig_.has_eyes)
        return truth;
    Eigen::Isometry3d left = rig_link(rig_.left_eye, poses);
    Eigen::Isometry3d right = rig_link(rig_.right_eye, poses);
    const Projection p = rig_project(rig_, left, right, truth.ball);
    truth.projection = p;
    truth.in_view = p.in_front && std::fabs(p.v_right) < rig_.height / 2.0 &&
                    std::fabs(p.v_left) < rig_.height / 2.0 &&
                    std::fabs(p.u_right) < rig_.width / 2.0 &&
                    std::fabs(p.u_left) < rig_.width / 2.0;
    truth.visible =
        visibility_of_ball(shapes(poses), right.translation(), truth.ball, config_.ball_radius);
    if (rig_.has_head)
        truth.fixation = rig_fixate(rig_, truth.ball);
    return truth;
}

} // namespace sim
