#include "simrobot/eyes/bystander.h"

#include <algorithm>

namespace sim
{
namespace
{

const double room_to_spare = 1.1;

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

/* How far the robot and what it holds reach from `centre`. */
double room_wanted(const Snapshot &snapshot, const Eigen::Vector3d &centre)
{
    double radius = (snapshot.ball - centre).norm() + snapshot.ball_radius;

    for (const Shape &shape : snapshot.shapes)
        radius = std::max(radius, (shape.pose.translation() - centre).norm() + reach_of(shape));
    return radius;
}

} // namespace

void Bystander::look_on(Snapshot *snapshot)
{
    if (radius_ == 0) {
        Eigen::AlignedBox3d box(snapshot->ball);
        for (const Shape &shape : snapshot->shapes)
            box.extend(shape.pose.translation());
        centre_ = box.center();
        radius_ = room_wanted(*snapshot, centre_);
    }
    double wanted = room_wanted(*snapshot, centre_);
    if (wanted > radius_) /* with room to spare: else every picture would be from elsewhere */
        radius_ = room_to_spare * wanted;
    snapshot->left_eye = camera_looking_at(centre_, {-0.6, 1, 0.5}, radius_ / half_view_);
    snapshot->right_eye = camera_looking_at(centre_, {-0.3, -1, 0.2}, radius_ / half_view_);
}

} // namespace sim
