#include "simrobot/world/rig.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "simrobot/setup/meshes.h"

namespace sim
{
namespace
{

const double radians_per_degree = M_PI / 180;

/* By so much a start may pass a limit that was rounded otherwise; rad, m. */
const double rounding = 1e-4;

std::vector<std::string> words_of(const char *names)
{
    std::istringstream lines(names);
    std::vector<std::string> words;

    for (std::string line; std::getline(lines, line);)
        words.push_back(line);
    return words;
}

/* Finds what the configuration names in a robot; everything that is wrong is gathered. */
class Finder
{
public:
    Finder(const Config &config, Rig *rig, Findings *findings)
        : config_(config), rig_(rig), findings_(findings)
    {
    }

    void find(const std::vector<std::string> &arm, const std::vector<std::string> &head)
    {
        add_joints(arm);
        rig_->n_arm = static_cast<int>(rig_->joints.size());
        add_joints(head);
        size_t n = rig_->joints.size();
        if (arm.empty() || n > static_cast<size_t>(max_joints))
            fault("robot: between 1 and " + std::to_string(max_joints) + " joints are wanted");
        bool complete = n == arm.size() + head.size(); /* else nothing may move */
        if (find_link(config_.hand_link, &rig_->hand) && rig_->hand.segment == 0 && complete)
            fault(rig_->description.path + ": link " + config_.hand_link + " does not move");
        find_collisions();
        find_eyes(head.size());
        if (complete)
            find_start();
    }

private:
    void fault(const std::string &line)
    {
        findings_->faults.push_back(line);
    }

    void add_joints(const std::vector<std::string> &names)
    {
        for (const std::string &name : names) {
            std::string error;
            int segment = description_joint(rig_->description, name, &error);
            if (segment < 0)
                fault(error);
            else if (std::count(rig_->joints.begin(), rig_->joints.end(), segment))
                fault("robot: joint " + name + " is named twice");
            else
                rig_->joints.push_back(segment);
        }
    }

    bool find_link(const char *name, LinkFrame *frame)
    {
        std::string error;
        const LinkFrame *found = description_link(rig_->description, name, &error);

        if (found)
            *frame = *found;
        else
            fault(error);
        return found != nullptr;
    }

    /* Who asks for collisions is told what would not collide. */
    void find_collisions()
    {
        Description *description = &rig_->description;

        if (!config_.collisions)
            return;
        mesh_collisions_load(config_.package_path, description, findings_);
        if (std::all_of(description->segments.begin(), description->segments.end(),
                        [](const Segment &segment) { return segment.collisions.empty(); }))
            fault(description->path + ": robot.collisions: no link has <collision>");
    }

    void find_eyes(size_t n_head)
    {
        if (!config_.left_eye[0] && !config_.right_eye[0] && n_head == 0)
            return;
        if (!config_.left_eye[0] || !config_.right_eye[0] || (n_head != 0 && n_head != 2)) {
            fault("robot: eyes need robot.left_eye, robot.right_eye and two robot.head_joints, or "
                  "none for eyes that do not turn");
            return;
        }
        rig_->has_eyes = true;
        rig_->has_head = n_head > 0;
        find_link(config_.left_eye, &rig_->left_eye);
        find_link(config_.right_eye, &rig_->right_eye);
    }

    /* The option is in degrees, which config_load made radians; a joint that slides means metres.
     */
    void find_start()
    {
        size_t n = rig_->joints.size(), given = static_cast<size_t>(config_.start.n);

        rig_->start.assign(n, 0.0);
        if (given != 0 && given != n) {
            fault("robot.start: " + std::to_string(n) + " angles are wanted");
            return;
        }
        for (size_t i = 0; i < n; i++)
            start_joint(i, given != 0);
    }

    void start_joint(size_t i, bool given)
    {
        const Segment &segment = rig_->description.segments[static_cast<size_t>(rig_->joints[i])];
        double at = given ? config_.start.value[i] / (segment.slides ? radians_per_degree : 1) : 0;

        rig_->start[i] = at;
        if (at >= segment.lower - rounding && at <= segment.upper + rounding)
            return;
        std::string where = "joint " + segment.name + ": " + text_of(segment, at) +
                            " is outside its limits, " + text_of(segment, segment.lower) + " .. " +
                            text_of(segment, segment.upper);
        double middle = (segment.lower + segment.upper) / 2;
        if (given)
            fault("robot.start: " + where);
        else
            rig_->notes.push_back(where + "; it starts at their middle, " +
                                  text_of(segment, middle));
        rig_->start[i] = middle;
    }

    static std::string text_of(const Segment &segment, double value)
    {
        char text[60];
        snprintf(text, sizeof text, segment.slides ? "%.4g m" : "%.4g deg",
                 segment.slides ? value : value / radians_per_degree);
        return text;
    }

    const Config &config_;
    Rig *rig_;
    Findings *findings_;
};

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
    std::vector<std::string> arm = words_of(config.arm_joints), head = words_of(config.head_joints);
    Findings findings;
    Wanted wanted{arm, config.repair_inertia};

    *rig = Rig{};
    rig->focal_length = config.focal_length;
    rig->width = config.width;
    rig->height = config.height;
    wanted.joints.insert(wanted.joints.end(), head.begin(), head.end());
    if (description_load(config.urdf, wanted, &rig->description, &findings))
        Finder(config, rig, &findings).find(arm, head);
    rig->notes.insert(rig->notes.begin(), findings.notes.begin(), findings.notes.end());
    error->clear();
    for (const std::string &fault : findings.faults)
        *error += (error->empty() ? "" : "\n") + fault;
    return findings.faults.empty();
}

std::vector<double> rig_any_posture(const Rig &rig, Random *random)
{
    std::vector<double> angles;

    for (int joint : rig.joints) {
        const Segment &segment = rig.description.segments[static_cast<size_t>(joint)];
        bool ends = std::isfinite(segment.lower);
        angles.push_back(ends ? random->uniform(segment.lower, segment.upper)
                              : random->uniform(-M_PI, M_PI));
    }
    return angles;
}

std::vector<double> rig_positions(const Rig &rig, const std::vector<double> &angles)
{
    const std::vector<Segment> &segments = rig.description.segments;
    std::vector<double> positions(segments.size(), 0.0);

    for (size_t i = 0; i < rig.joints.size(); i++)
        positions[static_cast<size_t>(rig.joints[i])] = angles[i];
    for (size_t i = 1; i < segments.size(); i++)
        if (segments[i].leader >= 0)
            positions[i] =
                segments[i].multiplier * positions[static_cast<size_t>(segments[i].leader)] +
                segments[i].offset;
    return positions;
}

std::vector<Eigen::Isometry3d> rig_poses(const Rig &rig, const std::vector<double> &positions)
{
    const std::vector<Segment> &segments = rig.description.segments;
    std::vector<Eigen::Isometry3d> poses(segments.size(), Eigen::Isometry3d::Identity());

    for (size_t i = 1; i < segments.size(); i++) {
        poses[i] = poses[static_cast<size_t>(segments[i].parent)] * segments[i].origin;
        if (segments[i].slides)
            poses[i] = poses[i] * Eigen::Translation3d(positions[i] * segments[i].axis);
        else
            poses[i] = poses[i] * Eigen::AngleAxisd(positions[i], segments[i].axis);
    }
    return poses;
}

std::vector<Eigen::Isometry3d> rig_forward(const Rig &rig, const std::vector<double> &angles)
{
    return rig_poses(rig, rig_positions(rig, angles));
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
