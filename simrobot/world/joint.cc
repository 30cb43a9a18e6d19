#include "simrobot/world/joint.h"

#include <cmath>

namespace sim
{
namespace
{

/* A stop is a rubber buffer: pushed with all of its motor's effort a joint passes it by this much
 * (rad, m), and at its limit speed the rubber's damping alone takes so many times that effort. A
 * stop of steel ends the motion within one step, and that blow throws the joints further out, whose
 * motors are weak: one of the shipped robots then went at three times its limit speed. */
const double hinge_yields = 1 * M_PI / 180, slider_yields = 0.002, stop_damps = 2;

} // namespace

Joint::Joint(World &world, const Segment &segment, const Eigen::Isometry3d &frame, dBodyID body,
             dBodyID parent, bool has_stops)
    : axis_(frame.linear() * segment.axis), body_(body), parent_(parent), slides_(segment.slides)
{
    if (slides_)
        make_slider(world, segment);
    else
        make_hinge(world, segment, frame.translation());
    if (!has_stops || !std::isfinite(segment.lower))
        return;
    if (!slides_)
        make_angle_stop(world);
    set_stop(world.step_length(), segment);
}

void Joint::make_hinge(World &world, const Segment &segment, const Eigen::Vector3d &anchor)
{
    joint_ = dJointCreateHinge(world.id(), nullptr);
    dJointAttach(joint_, body_, parent_);
    dJointSetHingeAnchor(joint_, anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(joint_, axis_.x(), axis_.y(), axis_.z());
    dJointSetHingeParam(joint_, dParamFMax, segment.effort);
    dJointSetHingeParam(joint_, dParamVel, 0);
}

void Joint::make_slider(World &world, const Segment &segment)
{
    joint_ = dJointCreateSlider(world.id(), nullptr);
    dJointAttach(joint_, body_, parent_);
    dJointSetSliderAxis(joint_, axis_.x(), axis_.y(), axis_.z());
    motor_ = dJointCreateLMotor(world.id(), nullptr);
    dJointAttach(motor_, body_, parent_);
    dJointSetLMotorNumAxes(motor_, 1);
    dJointSetLMotorAxis(motor_, 0, parent_ ? 2 : 0, axis_.x(), axis_.y(), axis_.z());
    dJointSetLMotorParam(motor_, dParamFMax, segment.effort);
    dJointSetLMotorParam(motor_, dParamVel, 0);
}

/* An angular motor without a motor: its stops look at the angle that drive() tells it, where those
 * of a hinge know an angle within one turn only. */
void Joint::make_angle_stop(World &world)
{
    stop_ = dJointCreateAMotor(world.id(), nullptr);
    dJointAttach(stop_, body_, parent_);
    dJointSetAMotorMode(stop_, dAMotorUser);
    dJointSetAMotorNumAxes(stop_, 1);
    dJointSetAMotorAxis(stop_, 0, 1, axis_.x(), axis_.y(), axis_.z());
}

/* ERP and CFM make a stop an implicit spring-damper, as in tool.cc. */
void Joint::set_stop(double step, const Segment &segment)
{
    double spring = segment.effort / (slides_ ? slider_yields : hinge_yields) * step;
    double damper = stop_damps * segment.effort / segment.velocity;
    auto *set = slides_ ? dJointSetSliderParam : dJointSetAMotorParam;
    dJointID stop = slides_ ? joint_ : stop_;

    set(stop, dParamStopERP, spring / (spring + damper));
    set(stop, dParamStopCFM, 1 / (spring + damper));
    set(stop, dParamLoStop, segment.lower);
    set(stop, dParamHiStop, segment.upper);
}

void Joint::drive(double speed)
{
    last_ = position();
    if (slides_)
        dJointSetLMotorParam(motor_, dParamVel, speed);
    else
        dJointSetHingeParam(joint_, dParamVel, speed);
    if (stop_)
        dJointSetAMotorAngle(stop_, 0, last_);
}

double Joint::position() const
{
    const double turn = 2 * M_PI;

    if (slides_)
        return dJointGetSliderPosition(joint_);
    double within_turn = dJointGetHingeAngle(joint_);
    return within_turn + turn * std::round((last_ - within_turn) / turn);
}

double Joint::velocity() const
{
    return slides_ ? dJointGetSliderPositionRate(joint_) : dJointGetHingeAngleRate(joint_);
}

} // namespace sim
