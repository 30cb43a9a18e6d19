/* A robot as its URDF file describes it, reduced to what moves: links joined by fixed joints are
 * one segment, and so are links whose joint nobody drives. Each segment but the first hangs on one
 * joint that turns or slides.
 *
 * Units: m, rad, kg. Segment frames are URDF's: the frame of a segment is its joint's frame. Of a
 * joint that slides, angles are metres and torques newtons. */
#ifndef SIMROBOT_SETUP_DESCRIPTION_H
#define SIMROBOT_SETUP_DESCRIPTION_H

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "simrobot/setup/findings.h"

namespace sim
{

enum class ShapeKind { sphere, cylinder, box, capsule, mesh };

using Triangles =
    std::vector<Eigen::Vector3f>; /* three corners each, counter-clockwise from outside */

/* Something to be drawn, to hide what is behind it, or to bump into. Cylinder and capsule lie along
 * z. */
struct Shape {
    ShapeKind kind;
    Eigen::Vector3d size; /* box: edges; sphere: radius; mesh: radius of a sphere about its origin
                           * that holds it; else radius, length (without caps) */
    Eigen::Isometry3d pose;
    Eigen::Vector3f colour;
    std::shared_ptr<const Triangles> triangles = nullptr; /* of a mesh, in its own frame */
};

/* A mesh under <visual>, which is read only when somebody looks, or under <collision>, which is
 * read only where links may collide (meshes.h). */
struct MeshPart {
    int segment;
    std::string link, file; /* as the URDF has them */
    Eigen::Vector3d scale;
    Eigen::Isometry3d pose; /* in the segment's frame */
    bool has_colour;        /* in the URDF; otherwise the file's counts */
    Eigen::Vector3f colour;
};

/* A joint, and the segment that it carries. */
struct Segment {
    std::string name;          /* of the joint; the base has "" */
    int parent;                /* index, always smaller than the own; the base has -1 */
    Eigen::Isometry3d origin;  /* joint frame in the parent's frame, at angle 0 */
    bool slides;               /* along the axis; otherwise it turns about it */
    Eigen::Vector3d axis;      /* unit vector in the joint frame */
    double lower, upper;       /* rad; infinite for a continuous joint */
    double effort;             /* largest torque of its motor, N m */
    double velocity;           /* largest speed of its motor, rad/s */
    int leader;                /* <mimic>: the segment whose angle this one's follows; else -1 */
    double multiplier, offset; /* angle = multiplier * the leader's + offset */
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
    std::vector<MeshPart> meshes, mesh_collisions;
};

/* What of a URDF is wanted. */
struct Wanted {
    std::vector<std::string> joints; /* these are driven; all others stand where URDF has zero */
    bool repair_inertia = false;     /* a link without a possible inertia takes that of a ball */
};

/* Reads a URDF file. What is wrong or guessed is in `findings`, each with file, line and the name
 * of joint or link. returns false when there is no robot to go on with; with faults it must not be
 * simulated */
bool description_load(const std::string &path, const Wanted &wanted, Description *description,
                      Findings *findings);

/* The driven segment that this joint carries.
 *   returns -1 with one line in `error` that names file and joint. */
int description_joint(const Description &description, const std::string &name, std::string *error);

/* The link of this name.
 *   returns nullptr with one line in `error` that names file and link. */
const LinkFrame *description_link(const Description &description, const std::string &name,
                                  std::string *error);

} // namespace sim
#endif
