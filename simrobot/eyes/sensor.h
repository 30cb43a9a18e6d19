/* The image sensor: adds noise to every byte of an image. */
#ifndef SIMROBOT_EYES_SENSOR_H
#define SIMROBOT_EYES_SENSOR_H

#include <cstdint>
#include <vector>

namespace sim
{

class Sensor
{
public:
    /* `noise`: standard deviation, grey levels of 255. */
    Sensor(double noise, uint64_t seed);

    /* Adds the noise of the image pair of this number; depends on nothing else. The noise is one
     * long tape of Gaussian numbers, begun at another place each time: as good as new, and cheap.
     */
    void expose(int64_t number, std::vector<uint8_t> *pixels) const;

private:
    double noise_;
    uint64_t seed_;
    std::vector<int8_t> tape_;
};

} // namespace sim
#endif
