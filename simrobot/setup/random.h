/* Random numbers that are the same on every machine: xoshiro256** seeded by splitmix64. */
#ifndef SIMROBOT_SETUP_RANDOM_H
#define SIMROBOT_SETUP_RANDOM_H

#include <cstdint>

namespace sim
{

class Random
{
public:
    /* Streams of one seed do not overlap in practice: one a purpose (encoders, light, ...). Within
     * a stream, each `index` (the number of an image, say) begins anew elsewhere. */
    Random(uint64_t seed, uint64_t stream, int64_t index = 0);

    uint64_t bits();

    /* Uniform in [0, 1). */
    double uniform();

    /* Uniform in [low, high). */
    double uniform(double low, double high);

    /* Mean 0, standard deviation 1, as the sum of twelve uniform numbers: no libm, so the same
     * bits everywhere; never beyond 6. */
    double gaussian();

private:
    uint64_t state_[4] = {};
};

} // namespace sim
#endif
