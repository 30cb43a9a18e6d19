#include "learner/finder/urdf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <string>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#include <vector>

namespace
{

using Joint = urdf::JointConstSharedPtr;
using Link = urdf::LinkConstSharedPtr;

bool moves(const Joint &joint)
{
    return joint->type == urdf::Joint::REVOLUTE || joint->type == urdf::Joint::CONTINUOUS ||
           joint->type == urdf::Joint::PRISMATIC;
}

/* From the root to the link. */
std::vector<Joint> path_to(Link link)
{
    std::vector<Joint> path;

    for (; link && link->parent_joint; link = link->getParent())
        path.push_back(link->parent_joint);
    std::reverse(path.begin(), path.end());
    return path;
}

long moving(const std::vector<Joint> &path)
{
    return std::count_if(path.begin(), path.end(), moves);
}

/* The path with most moving joints; of equals the first by the link's name. */
std::vector<Joint> longest_path(const urdf::ModelInterface &model)
{
    std::vector<Joint> best;

    for (const auto &[name, link] : model.links_) {
        std::vector<Joint> path = path_to(link);
        if (moving(path) > moving(best))
            best = path;
    }
    return best;
}

Eigen::Isometry3d frame_of(const urdf::Pose &pose)
{
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    const urdf::Rotation &r = pose.rotation;

    frame.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
    frame.translation() << pose.position.x, pose.position.y, pose.position.z;
    return frame;
}

/* Joints before the last n stay where they are at zero. */
bool fill(const std::vector<Joint> &path, int n, struct chain *chain)
{
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    long skipped = moving(path) - n;
    int i = 0;

    *chain = {};
    chain->n = n;
    for (const Joint &joint : path) {
        frame = frame * frame_of(joint->parent_to_joint_origin_transform);
        if (!moves(joint) || skipped-- > 0)
            continue;
        Eigen::Vector3d axis(joint->axis.x, joint->axis.y, joint->axis.z);
        if (!(axis.norm() > 1e-6))
            return false;
        Eigen::Map<Eigen::Vector3d>(chain->axis[i]) = frame.linear() * axis.normalized();
        Eigen::Map<Eigen::Vector3d>(chain->offset[i]) = frame.translation() - before;
        chain->slides[i] = joint->type == urdf::Joint::PRISMATIC;
        before = frame.translation();
        i++;
    }
    return true;
}

} // namespace

int finder_read_urdf(const char *path, const char *tip, int n_joints, struct chain *chain,
                     char *error, size_t error_size)
{
    urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(path);

    if (!model) {
        std::snprintf(error, error_size, "%s: this is no URDF that can be read", path);
        return -1;
    }
    Link link = tip ? model->getLink(tip) : nullptr;
    if (tip && !link) {
        std::snprintf(error, error_size, "%s: it has no link %s", path, tip);
        return -1;
    }
    std::vector<Joint> joints = link ? path_to(link) : longest_path(*model);
    if (moving(joints) < n_joints) {
        std::snprintf(error, error_size, "%s: its chain has %ld moving joints, %d are wanted", path,
                      moving(joints), n_joints);
        return -1;
    }
    if (!fill(joints, n_joints, chain)) {
        std::snprintf(error, error_size, "%s: a joint of its chain has no direction", path);
        return -1;
    }
    return 0;
}
