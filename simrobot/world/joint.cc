#include "simrobot/world/joint.h"

#include <cmath>

namespace sim
{
namespace
{

/* A stop is stiff rubber: pushed with all of its motor's effort a joint passes it by this much
 * (rad), and at its limit speed the rubber's damping alone takes so many times that effort. A stop
 * of steel ends the motion within one step, and that blow throws the joints further out: one of the
 * shipped robots then went at three times its limit speed. */
const double stop_yields = 0.1 * M_PI / 180, stop_damps = 2;

} // namespace

Joint::Joint(World &world, const Segment &segment, const Eigen::Isometry3d &frame, dBodyID body,
             dBodyID parent, bool has_stops)
    : hinge_(dJointCreateHinge(world.id(), nullptr))
{
    Eigen::Vector3d axis = frame.linear() * segment.axis;

    dJointAttach(hinge_, body, parent);
    dJointSetHingeAnchor(hinge_, frame.translation().x(), frame.translation().y(),
                         frame.translation().z());
    dJointSetHingeAxis(hinge_, axis.x(), axis.y(), axis.z());
    dJointSetHingeParam(hinge_, dParamFMax, segment.effort);
    dJointSetHingeParam(hinge_, dParamVel, 0);
    if (has_stops && std::isfinite(segment.lower))
        add_stop(world, segment, axis, body, parent);
}

/* An angular motor without a motor: its stops look at the angle that drive() tells it. ERP and CFM
 * make a stop an implicit spring-damper, as in tool.cc. */
void Joint::add_stop(World &world, const Segment &segment, const Eigen::Vector3d &axis,
                     dBodyID body, dBodyID parent)
{
    double spring = segment.effort / stop_yields * world.step_length();
    double damper = stop_damps * segment.effort / segment.velocity;

    stop_ = dJointCreateAMotor(world.id(), nullptr);
    dJointAttach(stop_, body, parent);
    dJointSetAMotorMode(stop_, dAMotorUser);
    dJointSetAMotorNumAxes(stop_, 1);
    dJointSetAMotorAxis(stop_, 0, 1, axis.x(), axis.y(), axis.z());
    dJointSetAMotorParam(stop_, dParamStopERP, spring / (spring + damper));
    dJointSetAMotorParam(stop_, dParamStopCFM, 1 / (spring + damper));
    dJointSetAMotorParam(stop_, dParamLoStop, segment.lower);
    dJointSetAMotorParam(stop_, dParamHiStop, segment.upper);
}

void Joint::drive(double speed)
{
    last_ = position();
    dJointSetHingeParam(hinge_, dParamVel, speed);
    if (stop_)
        dJointSetAMotorAngle(stop_, 0, last_);
}

double Joint::position() const
{
    const double turn = 2 * M_PI;
    double within_turn = dJointGetHingeAngle(hinge_);

    return within_turn + turn * std::round((last_ - within_turn) / turn);
}

double Joint::velocity() const
{
    return dJointGetHingeAngleRate(hinge_);
}

} // namespace sim
