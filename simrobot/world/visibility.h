/* How much of the ball an eye can see, by rays: the truth that reports judge vision against. */
#ifndef SIMROBOT_WORLD_VISIBILITY_H
#define SIMROBOT_WORLD_VISIBILITY_H

#include "simrobot/setup/description.h"

namespace sim
{

/* Whether the straight line between two points (base frame) meets the shape. */
bool visibility_blocks(const Shape &shape, const Eigen::Vector3d &from, const Eigen::Vector3d &to);

/* Share of the ball's disc, as seen from `eye`, that no shape hides; 0 .. 1. */
double visibility_of_ball(const std::vector<Shape> &shapes, const Eigen::Vector3d &eye,
                          const Eigen::Vector3d &ball, double radius);

} // namespace sim
#endif
