#include "simrobot/world/rig.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sim
{
namespace
{

/* Joints that are named in a text, separated by spaces. */
bool add_joints(const char *names, Rig *rig, std::string *error)
{
    std::istringstream words(names);
    std::string name;

    while (words >> name) {
        int segment = description_joint(rig->description, name, error);
        if (segment < 0)
            return false;
        if (std::count(rig->joints.begin(), rig->joints.end(), segment)) {
            *error = "robot: joint " + name + " is named twice";
            return false;
        }
        rig->joints.push_back(segment);
    }
    return true;
}

bool find_link(const Rig &rig, const char *name, LinkFrame *frame, std::string *error)
{
    const LinkFrame *found = description_link(rig.description, name, error);

    if (!found)
        return false;
    *frame = *found;
    return true;
}

/* Who asks for collisions is told what would not collide. */
bool find_collisions(const Config &config, const Rig &rig, std::string *error)
{
    const Description &description = rig.description;
    bool any = std::any_of(description.segments.begin(), description.segments.end(),
                           [](const Segment &segment) { return !segment.collisions.empty(); });

    if (!config.collisions || (any && description.mesh_link.empty()))
        return true;
    *error = description.path + ": robot.collisions: " +
             (any || !description.mesh_link.empty()
                  ? "<collision> of link " + description.mesh_link +
                        " is a mesh; make it of boxes, cylinders and spheres"
                  : "no link has <collision>");
    return false;
}

bool find_eyes(const Config &config, Rig *rig, std::string *error)
{
    size_t n_head = rig->joints.size() - static_cast<size_t>(rig->n_arm);

    if (!config.left_eye[0] && !config.right_eye[0] && n_head == 0)
        return true;
    if (!config.left_eye[0] || !config.right_eye[0] || n_head != 2) {
        *error = "robot: eyes need robot.left_eye, robot.right_eye and two robot.head_joints";
        return false;
    }
    rig->has_eyes = true;
    return find_link(*rig, config.left_eye, &rig->left_eye, error) &&
           find_link(*rig, config.right_eye, &rig->right_eye, error);
}

struct PixelPoint {
    double u, v;
    bool in_front;
};

PixelPoint project_one(double focal_length, const Eigen::Isometry3d &eye,
                       const Eigen::Vector3d &point)
{
    Eigen::Vector3d p = eye.inverse() * point;
    if (p.x() < 1e-3)
        return {0, 0, false};
    return {-focal_length * p.y() / p.x(), -focal_length * p.z() / p.x(), true};
}

Projection project_with_head(const Rig &rig, double yaw, double pitch, const Eigen::Vector3d &point)
{
    std::vector<double> angles(rig.joints.size(), 0.0);
    angles[static_cast<size_t>(rig.n_arm)] = yaw;
    angles[static_cast<size_t>(rig.n_arm) + 1] = pitch;
    std::vector<Eigen::Isometry3d> poses = rig_forward(rig, angles);
    return rig_project(rig, rig_link(rig.left_eye, poses), rig_link(rig.right_eye, poses), point);
}

bool within(const Segment &segment, double angle)
{
    return angle >= segment.lower && angle <= segment.upper;
}

} // namespace

bool rig_load(const Config &config, Rig *rig, std::string *error)
{
    *rig = Rig{};
    rig->focal_length = config.focal_length;
    rig->width = config.width;
    rig->height = config.height;
    if (!description_load(config.urdf, &rig->description, error) ||
        !add_joints(config.arm_joints, rig, error))
        return false;
    rig->n_arm = static_cast<int>(rig->joints.size());
    if (!add_joints(config.head_joints, rig, error) ||
        !find_link(*rig, config.hand_link, &rig->hand, error))
        return false;
    if (rig->hand.segment == 0) {
        *error = rig->description.path + ": link " + config.hand_link + " does not move";
        return false;
    }
    if (rig->n_arm == 0 || rig->joints.size() > static_cast<size_t>(max_joints)) {
        *error = "robot: between 1 and " + std::to_string(max_joints) + " joints are wanted";
        return false;
    }
    if (config.start.n != 0 && config.start.n != static_cast<int>(rig->joints.size())) {
        *error = "robot.start: " + std::to_string(rig->joints.size()) + " angles are wanted";
        return false;
    }
    return find_collisions(config, *rig, error) && find_eyes(config, rig, error);
}

std::vector<Eigen::Isometry3d> rig_forward(const Rig &rig, const std::vector<double> &angles)
{
    const std::vector<Segment> &segments = rig.description.segments;
    std::vector<double> turn(segments.size(), 0.0);
    std::vector<Eigen::Isometry3d> poses(segments.size(), Eigen::Isometry3d::Identity());

    for (size_t i = 0; i < rig.joints.size(); i++)
        turn[static_cast<size_t>(rig.joints[i])] = angles[i];
    for (size_t i = 1; i < segments.size(); i++)
        poses[i] = poses[static_cast<size_t>(segments[i].parent)] * segments[i].origin *
                   Eigen::AngleAxisd(turn[i], segments[i].axis);
    return poses;
}

Eigen::Isometry3d rig_link(const LinkFrame &link, const std::vector<Eigen::Isometry3d> &segments)
{
    return segments[static_cast<size_t>(link.segment)] * link.pose;
}

Projection rig_project(const Rig &rig, const Eigen::Isometry3d &left_eye,
                       const Eigen::Isometry3d &right_eye, const Eigen::Vector3d &point)
{
    PixelPoint left = project_one(rig.focal_length, left_eye, point);
    PixelPoint right = project_one(rig.focal_length, right_eye, point);

    return {right.u, right.v, left.u, left.v, left.in_front && right.in_front};
}

Fixation rig_fixate(const Rig &rig, const Eigen::Vector3d &point)
{
    const double step = 1e-6, largest_turn = 0.3, close_enough = 1e-6;
    const Segment &yaw_joint =
        rig.description.segments[static_cast<size_t>(rig.joints[static_cast<size_t>(rig.n_arm)])];
    const Segment &pitch_joint =
        rig.description
            .segments[static_cast<size_t>(rig.joints[static_cast<size_t>(rig.n_arm) + 1])];
    Fixation fixation = {};

    for (int i = 0; i < 30 && !fixation.converged; i++) {
        Projection at = project_with_head(rig, fixation.yaw, fixation.pitch, point);
        Projection yaw = project_with_head(rig, fixation.yaw + step, fixation.pitch, point);
        Projection pitch = project_with_head(rig, fixation.yaw, fixation.pitch + step, point);
        if (!at.in_front || !yaw.in_front || !pitch.in_front)
            return fixation;
        Eigen::Matrix2d jacobian;
        jacobian << yaw.u_right - at.u_right, pitch.u_right - at.u_right, yaw.v_right - at.v_right,
            pitch.v_right - at.v_right;
        Eigen::Vector2d pixel(at.u_right, at.v_right);
        Eigen::Vector2d turn = -(jacobian / step).inverse() * pixel;
        fixation.yaw += std::clamp(turn.x(), -largest_turn, largest_turn);
        fixation.pitch += std::clamp(turn.y(), -largest_turn, largest_turn);
        fixation.disparity = at.u_left - at.u_right;
        fixation.converged = pixel.norm() < close_enough;
    }
    fixation.within_limits = fixation.converged && within(yaw_joint, fixation.yaw) &&
                             within(pitch_joint, fixation.pitch);
    return fixation;
}

} // namespace sim
