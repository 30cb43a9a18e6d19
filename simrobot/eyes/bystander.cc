#include "simrobot/eyes/bystander.h"

#include <algorithm>

namespace sim
{
namespace
{

/* Half the longest extent of a shape, whichever way it is turned. */
double reach_of(const Shape &shape)
{
    switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::mesh:
        return shape.size.x();
    case ShapeKind::box:
        return shape.size.norm() / 2;
    default: /* cylinder and capsule: radius, length */
        return shape.size.x() + shape.size.y() / 2;
    }
}

/* Looks along x at `target` from `distance` away in the direction `from`; z up. */
Eigen::Isometry3d camera_looking_at(const Eigen::Vector3d &target, const Eigen::Vector3d &from,
                                    double distance)
{
    Eigen::Matrix3d axes;

    axes.col(0) = -from.normalized();
    axes.col(1) = Eigen::Vector3d::UnitZ().cross(axes.col(0)).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return Eigen::Translation3d(target + distance * from.normalized()) * Eigen::Isometry3d(axes);
}

} // namespace

void bystander_look_on(double half_view, Snapshot *snapshot)
{
    Eigen::AlignedBox3d box(snapshot->ball);
    double radius = snapshot->ball_radius;

    for (const Shape &shape : snapshot->shapes)
        box.extend(shape.pose.translation());
    for (const Shape &shape : snapshot->shapes)
        radius =
            std::max(radius, (shape.pose.translation() - box.center()).norm() + reach_of(shape));
    radius = std::max(radius, (snapshot->ball - box.center()).norm() + snapshot->ball_radius);
    snapshot->left_eye = camera_looking_at(box.center(), {-0.6, 1, 0.5}, radius / half_view);
    snapshot->right_eye = camera_looking_at(box.center(), {-0.3, -1, 0.2}, radius / half_view);
}

} // namespace sim
