#include "simrobot/light.h"

#include <Eigen/Geometry>
#include <cmath>

#include "simrobot/random.h"

namespace sim
{
namespace
{

enum Quantity { azimuth, height, strength, warmth, fill };

const double full_turn = 6.283185307179586;

} // namespace

Light::Light(const Config &config, uint64_t seed)
    : drift_(config.light_drift), flicker_(config.light_flicker), seed_(seed)
{
    Random random(seed, 2);

    for (int q = 0; q < quantities; q++)
        for (int w = 0; w < waves; w++) {
            double slowest = full_turn / config.light_period;
            frequency_[q][w] = slowest * (w + 1) * random.uniform(0.8, 1.25);
            phase_[q][w] = random.uniform(0, full_turn);
        }
}

/* A smooth number about -1 .. 1 that never quite repeats. */
double Light::wander(int quantity, double seconds) const
{
    double sum = 0, amplitude = 0.6;

    for (int w = 0; w < waves; w++) {
        sum += amplitude * std::sin(frequency_[quantity][w] * seconds + phase_[quantity][w]);
        amplitude *= 0.5;
    }
    return sum * drift_;
}

LightState Light::at(double seconds, int64_t exposure, double brightness) const
{
    Random lamp(seed_ + static_cast<uint64_t>(exposure), 3);
    double turn = 0.5 + 0.6 * wander(azimuth, seconds);
    double up = 0.95 + 0.25 * wander(height, seconds);
    double power = brightness * (1 + 0.18 * wander(strength, seconds));
    double warm = 0.07 * wander(warmth, seconds);
    LightState state;

    /* A lamp behind the robot's shoulder and above, so that what it looks at is lit. */
    state.direction =
        Eigen::Vector3d(-0.55 * std::cos(turn), std::sin(turn), up).normalized().cast<float>();
    double direct = 0.85 * power * (1 + flicker_ * lamp.gaussian());
    state.colour = Eigen::Vector3d(direct * (1 + warm), direct, direct * (1 - warm)).cast<float>();
    double round =
        0.38 * power * (1 + 0.12 * wander(fill, seconds)) * (1 + flicker_ * lamp.gaussian());
    state.ambient =
        Eigen::Vector3d(round * (1 - 0.5 * warm), round, round * (1 + 0.5 * warm)).cast<float>();
    return state;
}

} // namespace sim
