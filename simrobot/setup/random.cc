#include "simrobot/setup/random.h"

namespace sim
{
namespace
{

uint64_t rotate_left(uint64_t x, int k)
{
    return (x << k) | (x >> (64 - k));
}

uint64_t splitmix(uint64_t *x)
{
    uint64_t z = (*x += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

} // namespace

Random::Random(uint64_t seed, uint64_t stream, int64_t index)
{
    uint64_t x = seed ^ (stream * 0xd1342543de82ef95u);

    x = splitmix(&x) ^ (static_cast<uint64_t>(index) * 0xaf251af3b0f025b5u);
    for (uint64_t &word : state_)
        word = splitmix(&x);
}

uint64_t Random::bits()
{
    uint64_t result = rotate_left(state_[1] * 5, 7) * 9;
    uint64_t t = state_[1] << 17;

    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate_left(state_[3], 45);
    return result;
}

double Random::uniform()
{
    return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double Random::uniform(double low, double high)
{
    return low + (high - low) * uniform();
}

double Random::gaussian()
{
    double sum = -6;
    for (int i = 0; i < 12; i++)
        sum += uniform();
    return sum;
}

} // namespace sim
