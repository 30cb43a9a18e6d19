/* The parts of a robot that the configuration names, found in its URDF, and its kinematics: where
 * the links are for given joint angles, what the eyes see of a point, how the head fixates it.
 * Nothing here simulates; the same functions serve ground truth and tests. */
#ifndef SIMROBOT_WORLD_RIG_H
#define SIMROBOT_WORLD_RIG_H

#include "simrobot/setup/config.h"
#include "simrobot/setup/description.h"
#include "simrobot/setup/random.h"

namespace sim
{

struct Rig {
    Description description;
    std::vector<int> joints; /* segments in the order of the messages: arm, then head */
    int n_arm;
    std::vector<double> start;      /* rad, in the order of `joints`; within their limits */
    std::vector<std::string> notes; /* what was mended, guessed or left out, a line each */
    LinkFrame hand;
    bool has_eyes; /* two eyes are named, */
    bool has_head; /* and two joints that turn them */
    LinkFrame left_eye, right_eye;
    double focal_length; /* px */
    int width, height;   /* px */
};

/* A point as both eyes see it. Origin at the image centre, u to the right, v down; px. */
struct Projection {
    double u_right, v_right, u_left, v_left;
    bool in_front; /* of both eyes; if not, the numbers mean nothing */
};

/* The head's angles at which the right eye looks at a point, and the disparity then. */
struct Fixation {
    double yaw, pitch; /* rad */
    double disparity;  /* u_left - u_right, px */
    bool converged;
    bool within_limits;
};

/* Reads the URDF and finds every named part in it.
 *   returns false with all that is wrong in `error`, a line each. */
bool rig_load(const Config &config, Rig *rig, std::string *error);

/* Angles of `joints` that their limits allow (rad, m); of one that turns without end, a turn. */
std::vector<double> rig_any_posture(const Rig &rig, Random *random);

/* Angles of all segments' joints, those that follow others included (rad, m). `angles` in the order
 * of `joints`. */
std::vector<double> rig_positions(const Rig &rig, const std::vector<double> &angles);

/* Poses of all segments in the base's frame, for the positions of all segments' joints. */
std::vector<Eigen::Isometry3d> rig_poses(const Rig &rig, const std::vector<double> &positions);

/* The same for these angles of `joints`. */
std::vector<Eigen::Isometry3d> rig_forward(const Rig &rig, const std::vector<double> &angles);

/* Pose of a link in the base's frame, given the poses of the segments. */
Eigen::Isometry3d rig_link(const LinkFrame &link, const std::vector<Eigen::Isometry3d> &segments);

/* What the eyes see of `point` (base frame) when their links have these poses. */
Projection rig_project(const Rig &rig, const Eigen::Isometry3d &left_eye,
                       const Eigen::Isometry3d &right_eye, const Eigen::Vector3d &point);

/* Solves for the head that fixates `point`, by Newton's method from the head straight ahead. The
 * rig has a head. */
Fixation rig_fixate(const Rig &rig, const Eigen::Vector3d &point);

} // namespace sim
#endif
