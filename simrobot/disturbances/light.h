/* The light that falls on the scene: it wanders slowly, as daylight through a window does, and
 * flickers a little from image to image. This is what makes a measured marker wrong. */
#ifndef SIMROBOT_DISTURBANCES_LIGHT_H
#define SIMROBOT_DISTURBANCES_LIGHT_H

#include <Eigen/Core>
#include <cstdint>

#include "simrobot/disturbances/wander.h"
#include "simrobot/setup/config.h"

namespace sim
{

struct LightState {
    Eigen::Vector3f direction; /* towards the lamp, base frame, length 1 */
    Eigen::Vector3f colour;    /* of the lamp's light; brightness included */
    Eigen::Vector3f ambient;   /* of the light from all sides */
};

class Light
{
public:
    Light(const Config &config, uint64_t seed);

    /* The light at `seconds` since the start, for the image pair of this number. `brightness` is
     * the experimenter's, 1 as configured. Depends on nothing else. */
    LightState at(double seconds, int64_t exposure, double brightness) const;

private:
    double drift_, flicker_;
    uint64_t seed_;
    Random random_; /* before what draws from it */
    Wander azimuth_, height_, strength_, warmth_, fill_;
};

} // namespace sim
#endif
