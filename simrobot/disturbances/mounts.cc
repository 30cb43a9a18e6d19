#include "simrobot/disturbances/mounts.h"

namespace sim
{
namespace
{

/* Both eyes sit on one head: most of the motion is common to them. */
const double common_share = 0.95, own_share = 0.3;

Eigen::Quaterniond turn(double yaw, double pitch)
{
    return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
}

} // namespace

Mounts::Mounts(const Config &config, uint64_t seed)
    : tremble_(config.eye_tremble), creep_(config.eye_creep), seed_(seed), random_(seed, 6),
      yaw_(config.eye_creep_period, &random_), pitch_(config.eye_creep_period, &random_),
      left_yaw_(config.eye_creep_period, &random_), right_yaw_(config.eye_creep_period, &random_)
{
}

MountTurns Mounts::at(double seconds, int64_t exposure) const
{
    Random hum(seed_, 7, exposure);
    double yaw = common_share * (creep_ * yaw_.at(seconds) + tremble_ * hum.gaussian());
    double pitch = creep_ * pitch_.at(seconds) + tremble_ * hum.gaussian();
    double left = own_share * (creep_ * left_yaw_.at(seconds) + tremble_ * hum.gaussian());
    double right = own_share * (creep_ * right_yaw_.at(seconds) + tremble_ * hum.gaussian());

    return {turn(yaw + left, pitch), turn(yaw + right, pitch)};
}

} // namespace sim
