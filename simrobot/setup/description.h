/* A robot as its URDF file describes it, reduced to what moves: links joined by fixed joints are
 * one segment, and each segment but the first hangs on one revolute joint.
 *
 * Units: m, rad, kg. Segment frames are URDF's: the frame of a segment is its joint's frame. */
#ifndef SIMROBOT_SETUP_DESCRIPTION_H
#define SIMROBOT_SETUP_DESCRIPTION_H

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

namespace sim
{

enum class ShapeKind { sphere, cylinder, box, capsule };

/* Something to be drawn, to hide what is behind it, or to bump into. Cylinder and capsule lie along
 * z. */
struct Shape {
    ShapeKind kind;
    Eigen::Vector3d size; /* box: edges; sphere: radius; else radius, length (without caps) */
    Eigen::Isometry3d pose;
    Eigen::Vector3f colour;
};

/* A revolute joint, and the segment that it carries. */
struct Segment {
    std::string name;         /* of the joint; the base has "" */
    int parent;               /* index, always smaller than the own; the base has -1 */
    Eigen::Isometry3d origin; /* joint frame in the parent's frame, at angle 0 */
    Eigen::Vector3d axis;     /* unit vector in the joint frame */
    double lower, upper;      /* rad; infinite for a continuous joint */
    double effort;            /* largest torque of its motor, N m */
    double velocity;          /* largest speed of its motor, rad/s */
    double mass;
    Eigen::Vector3d centre_of_mass;
    Eigen::Matrix3d inertia;       /* about the centre of mass, axes of the segment */
    std::vector<Shape> shapes;     /* URDF's <visual> */
    std::vector<Shape> collisions; /* URDF's <collision>, without colour */
};

/* Where a link of the URDF sits. */
struct LinkFrame {
    int segment;
    Eigen::Isometry3d pose; /* in the segment's frame */
};

struct Description {
    std::string path;
    std::vector<Segment> segments; /* [0] is the base, which stands still */
    std::map<std::string, LinkFrame> links;
    std::string
        mesh_link; /* one whose <collision> is not simulated, for it is a mesh; "" if none */
};

/* Reads a URDF file; every fault is refused with the file and the name of the joint or link.
 *   returns false with one line in `error`. */
bool description_load(const std::string &path, Description *description, std::string *error);

/* The segment that this joint carries.
 *   returns -1 with one line in `error` that names file and joint. */
int description_joint(const Description &description, const std::string &name, std::string *error);

/* The link of this name.
 *   returns nullptr with one line in `error` that names file and link. */
const LinkFrame *description_link(const Description &description, const std::string &name,
                                  std::string *error);

} // namespace sim
#endif
