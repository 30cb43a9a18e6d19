/* Mass and inertia of what moves as one, and whether a real body can have them. */
#ifndef SIMROBOT_SETUP_INERTIA_H
#define SIMROBOT_SETUP_INERTIA_H

#include <Eigen/Geometry>
#include <string>

namespace sim
{

struct Inertia {
    double mass = 0; /* kg */
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    Eigen::Matrix3d about_centre = Eigen::Matrix3d::Zero(); /* kg m2, axes of the frame in use */
};

/* Both as one body (Steiner's theorem), in the same frame. */
Inertia inertia_sum(const Inertia &one, const Inertia &other);

/* The same body seen from another frame. */
Inertia inertia_moved(const Inertia &inertia, const Eigen::Isometry3d &frame);

/* Why no link can be so; "" if one can. A small part may be a point or a thin rod, and in some
 * files its moments are those of no body: that matters only to the sum of what moves together. */
std::string inertia_impossible(const Inertia &link);

/* Why what moves together cannot be so; "" if it can. */
std::string inertia_immovable(const Inertia &body);

/* A ball of water of this mass there, or of 10 g if there is none. */
Inertia inertia_of_ball(double mass, const Eigen::Vector3d &centre);

} // namespace sim
#endif
