#include "simrobot/disturbances/light.h"

#include <Eigen/Geometry>
#include <cmath>

namespace sim
{
Light::Light(const Config &config, uint64_t seed)
    : drift_(config.light_drift), flicker_(config.light_flicker), seed_(seed), random_(seed, 2),
      azimuth_(config.light_period, &random_), height_(config.light_period, &random_),
      strength_(config.light_period, &random_), warmth_(config.light_period, &random_),
      fill_(config.light_period, &random_)
{
}

LightState Light::at(double seconds, int64_t exposure, double brightness) const
{
    Random lamp(seed_, 3, exposure);
    double turn = 0.5 + 0.6 * drift_ * azimuth_.at(seconds);
    double up = 0.95 + 0.25 * drift_ * height_.at(seconds);
    double power = brightness * (1 + 0.18 * drift_ * strength_.at(seconds));
    double warm = 0.07 * drift_ * warmth_.at(seconds);
    LightState state;

    /* A lamp behind the robot's shoulder and above, so that what it looks at is lit. */
    state.direction =
        Eigen::Vector3d(-0.55 * std::cos(turn), std::sin(turn), up).normalized().cast<float>();
    double direct = 0.85 * power * (1 + flicker_ * lamp.gaussian());
    state.colour = Eigen::Vector3d(direct * (1 + warm), direct, direct * (1 - warm)).cast<float>();
    double round =
        0.38 * power * (1 + 0.12 * drift_ * fill_.at(seconds)) * (1 + flicker_ * lamp.gaussian());
    state.ambient =
        Eigen::Vector3d(round * (1 - 0.5 * warm), round, round * (1 + 0.5 * warm)).cast<float>();
    return state;
}

} // namespace sim
