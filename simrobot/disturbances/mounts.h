/* The mounts of the eyes give a little: they tremble while motors hum and creep as they warm. The
 * encoders do not feel it; the picture moves by it as a whole. */
#ifndef SIMROBOT_DISTURBANCES_MOUNTS_H
#define SIMROBOT_DISTURBANCES_MOUNTS_H

#include <Eigen/Geometry>

#include "simrobot/disturbances/wander.h"
#include "simrobot/setup/config.h"

namespace sim
{

/* How the eyes are turned away from where the robot believes them. */
struct MountTurns {
    Eigen::Quaterniond left, right;
};

class Mounts
{
public:
    Mounts(const Config &config, uint64_t seed);

    /* At `seconds` since the start, for the image pair of this number; depends on nothing else. */
    MountTurns at(double seconds, int64_t exposure) const;

private:
    double tremble_, creep_; /* rad */
    uint64_t seed_;
    Random random_; /* before what draws from it */
    Wander yaw_, pitch_, left_yaw_, right_yaw_;
};

} // namespace sim
#endif
