#include "simrobot/setup/drives.h"

#include <cmath>
#include <limits>

namespace sim
{
namespace
{

const double infinity = std::numeric_limits<double>::infinity();

/* Above this speed a joint could turn by more than a quarter turn within a step of 15 ms, and its
 * turns could no longer be counted; no robot comes near. rad/s */
const double fastest = 100;

/* No axis that somebody wrote down is shorter: it is a direction that was left out. */
const double shortest_axis = 1e-3;

bool slides(const urdf::Joint &joint)
{
    return joint.type == urdf::Joint::PRISMATIC;
}

bool turns(const urdf::Joint &joint)
{
    return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
}

Eigen::Vector3d axis_of(const urdf::Joint &joint)
{
    return {joint.axis.x, joint.axis.y, joint.axis.z};
}

std::string degrees_or_metres(const urdf::Joint &joint, double value)
{
    char text[60];
    snprintf(text, sizeof text, slides(joint) ? "%.4g m" : "%.4g deg",
             slides(joint) ? value : value * 180 / M_PI);
    return text;
}

} // namespace

/* A chain of followers is followed to its end. */
Drive Drives::of(const urdf::Joint &joint) const
{
    const urdf::Joint *at = &joint;
    Drive drive;

    for (size_t i = 0; i <= model_.joints_.size(); i++) {
        if (driven_.count(at->name)) {
            drive.leader = at->name;
            return drive;
        }
        if (!at->mimic || !(slides(*at) || turns(*at))) /* some files let fixed joints follow */
            return drive;
        drive.offset += drive.multiplier * at->mimic->offset;
        drive.multiplier *= at->mimic->multiplier;
        auto next = model_.joints_.find(at->mimic->joint_name);
        if (next == model_.joints_.end()) {
            source_->fault("joint", joint.name,
                           "<mimic> names joint " + at->mimic->joint_name + ", which is missing");
            return {};
        }
        at = next->second.get();
    }
    source_->fault("joint", joint.name, "<mimic> leads back to the joint itself");
    return {};
}

Eigen::Isometry3d Drives::moved(const urdf::Joint &joint, double angle)
{
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::Vector3d axis = axis_of(joint);

    if (angle == 0 || axis.norm() < shortest_axis)
        return pose;
    if (slides(joint))
        pose.translation() = angle * axis.normalized();
    else if (turns(joint))
        pose.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    return pose;
}

Segment Drives::segment(const urdf::Joint &joint, const Drive &drive, int parent,
                        const Eigen::Isometry3d &origin) const
{
    Segment segment = {};

    segment.name = joint.name;
    segment.parent = parent;
    segment.origin = origin;
    segment.slides = slides(joint);
    segment.axis = axis_of(joint).normalized();
    segment.lower = -infinity;
    segment.upper = segment.effort = segment.velocity = infinity;
    segment.leader = -1;
    segment.multiplier = drive.multiplier;
    segment.offset = drive.offset;
    segment.centre_of_mass.setZero();
    segment.inertia.setZero();
    if (!slides(joint) && !turns(joint))
        source_->fault("joint", joint.name,
                       "only revolute, continuous and prismatic joints are driven");
    else if (!(axis_of(joint).norm() >= shortest_axis))
        source_->fault("joint", joint.name, "its <axis> has no direction");
    if (drive.leader == joint.name) {
        set_limits(joint, &segment);
        set_motor(joint, &segment);
    }
    if (drive.leader == joint.name && joint.mimic)
        source_->fault("joint", joint.name,
                       "follows joint " + joint.mimic->joint_name +
                           " (<mimic>), but the configuration drives it; name that one instead");
    return segment;
}

void Drives::set_limits(const urdf::Joint &joint, Segment *segment) const
{
    if (joint.type == urdf::Joint::CONTINUOUS || !joint.limits)
        return;
    double lower = joint.limits->lower, upper = joint.limits->upper;
    bool has_lower = source_->has_limit(joint.name, "lower");
    bool has_upper = source_->has_limit(joint.name, "upper");
    std::string range = degrees_or_metres(joint, lower) + " .. " + degrees_or_metres(joint, upper);
    if (!has_lower && !has_upper)
        source_->fault("joint", joint.name, "its <limit> has neither lower nor upper");
    else if (!(lower < upper))
        source_->fault("joint", joint.name, "its limits leave it no range: " + range);
    else if (!has_lower || !has_upper)
        source_->note("joint", joint.name,
                      std::string("its <limit> has no ") + (has_lower ? "upper" : "lower") +
                          ", which is then 0: " + range);
    segment->lower = lower;
    segment->upper = upper;
}

void Drives::set_motor(const urdf::Joint &joint, Segment *segment) const
{
    if (!joint.limits) {
        source_->fault("joint", joint.name, "<limit effort=... velocity=...> is missing");
        return;
    }
    segment->effort = joint.limits->effort;
    segment->velocity = joint.limits->velocity;
    if (!(segment->effort > 0 && segment->velocity > 0) || !std::isfinite(segment->effort)) {
        source_->fault("joint", joint.name, "effort and velocity limits must be positive");
    } else if (segment->velocity > fastest) {
        source_->note("joint", joint.name,
                      "velocity " + std::to_string(segment->velocity) + " is taken as " +
                          std::to_string(static_cast<int>(fastest)));
        segment->velocity = fastest;
    }
}

} // namespace sim
