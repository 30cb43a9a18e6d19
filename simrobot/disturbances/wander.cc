#include "simrobot/disturbances/wander.h"

#include <cmath>

namespace sim
{

Wander::Wander(double period, Random *random)
{
    const double full_turn = 6.283185307179586;

    for (int w = 0; w < waves; w++) {
        frequency_[w] = full_turn / period * (w + 1) * random->uniform(0.8, 1.25);
        phase_[w] = random->uniform(0, full_turn);
    }
}

double Wander::at(double seconds) const
{
    double sum = 0, amplitude = 0.6;

    for (int w = 0; w < waves; w++) {
        sum += amplitude * std::sin(frequency_[w] * seconds + phase_[w]);
        amplitude *= 0.5;
    }
    return sum;
}

} // namespace sim
