#include "simrobot/eyes/sensor.h"

#include <algorithm>
#include <cmath>

#include "simrobot/setup/random.h"

namespace sim
{
namespace
{

const size_t tape_length = 1 << 18;

/* In int16 lanes, which every compiler turns into vector instructions. */
void add_saturated(uint8_t *__restrict pixels, const int8_t *__restrict noise, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        auto sum = static_cast<int16_t>(pixels[i] + noise[i]);
        sum = std::max<int16_t>(sum, 0);
        pixels[i] = static_cast<uint8_t>(std::min<int16_t>(sum, 255));
    }
}

} // namespace

Sensor::Sensor(double noise, uint64_t seed) : noise_(noise), seed_(seed)
{
    Random random(seed, 4);

    for (size_t i = 0; i < tape_length && noise > 0; i++)
        tape_.push_back(
            static_cast<int8_t>(std::lround(std::clamp(noise * random.gaussian(), -127.0, 127.0))));
}

void Sensor::expose(int64_t number, std::vector<uint8_t> *pixels) const
{
    if (noise_ <= 0)
        return;
    Random random(seed_, 5, number);
    for (size_t done = 0; done < pixels->size();) {
        size_t start = random.bits() % (tape_length / 2);
        size_t n = std::min(tape_length - start, pixels->size() - done);
        add_saturated(pixels->data() + done, tape_.data() + start, n);
        done += n;
    }
}

} // namespace sim
