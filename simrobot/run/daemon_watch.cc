#include "simrobot/run/daemon_watch.h"

#include <cmath>

#include "simrobot/world/strength.h"

namespace sim
{
namespace
{

const int64_t again_us = 10000000;
const double strained = 0.7; /* of a motor's effort: what is left hardly moves the arm */

std::string number(double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.4g", value);
    return text;
}

bool does_not_follow(int fault)
{
    return fault == REACH_STATUS_T_FAULT_STILL || fault == REACH_STATUS_T_FAULT_REVERSED ||
           fault == REACH_STATUS_T_FAULT_ASTRAY;
}

} // namespace

const Segment *DaemonWatch::joint(int number) const
{
    if (number < 1 || static_cast<size_t>(number) > rig_.joints.size())
        return nullptr;
    int segment = rig_.joints[static_cast<size_t>(number) - 1];
    return &rig_.description.segments[static_cast<size_t>(segment)];
}

std::string DaemonWatch::look(const reach_status_t &status, const reach_robot_state_t &state,
                              int64_t now)
{
    bool refuses = status.refused_state != refused_ && status.refused_state != 0;
    bool begins = (refuses && !refuses_) || status.fault != fault_;
    std::string line;

    refused_ = status.refused_state;
    refuses_ = refuses;
    fault_ = status.fault;
    if (!begins && now - said_ < again_us)
        return "";
    if (refuses)
        line = refusal(status);
    else if (begins && does_not_follow(status.fault))
        line = fault(status, state);
    if (!line.empty())
        said_ = now;
    return line;
}

/* The daemon's numbers are of angles or of velocities; it alone knows which. */
std::string DaemonWatch::refusal(const reach_status_t &status) const
{
    const Segment *refused = joint(status.refused_joint);
    std::string state = "reachd refuses state " + std::to_string(status.refused_state) + ": ";

    if (!refused)
        return state + "is it configured for these " + std::to_string(rig_.joints.size()) +
               " joints?";
    return state + "joint " + refused->name + " is at " + number(status.refused_value) +
           ", which must be within " + number(status.refused_min) + " .. " +
           number(status.refused_max) + (refused->slides ? " m" : " rad") +
           "; do arm.min and arm.max of its configuration fit this robot?";
}

std::string DaemonWatch::fault(const reach_status_t &status, const reach_robot_state_t &state) const
{
    const Segment *stuck = joint(status.fault_joint);

    if (!stuck)
        return "";
    std::vector<double> positions(state.position, state.position + rig_.joints.size());
    double weight = std::fabs(
        gravity_torques(rig_, ball_mass_, positions)[static_cast<size_t>(status.fault_joint) - 1]);
    std::string unit = stuck->slides ? " N" : " N m";
    std::string line = "reachd stops: joint " + stuck->name + " does not follow; ";
    std::string needs = "its motor has " + number(stuck->effort) + unit +
                        ", and the weight here takes " + number(weight) + unit;
    if (weight > stuck->effort)
        return line + needs + ": it is too weak for this posture";
    return line + needs +
           (weight > strained * stuck->effort ? ": little is left to move the arm with"
                                              : ": something holds it");
}

} // namespace sim
