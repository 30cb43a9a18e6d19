/* A smooth number about -1 .. 1 that never quite repeats: what daylight and temperature do. */
#ifndef SIMROBOT_DISTURBANCES_WANDER_H
#define SIMROBOT_DISTURBANCES_WANDER_H

#include "simrobot/setup/random.h"

namespace sim
{

class Wander
{
public:
    /* `period`: of its slowest part, s. Draws its frequencies and phases from `random`. */
    Wander(double period, Random *random);

    double at(double seconds) const;

private:
    static constexpr int waves = 3;

    double frequency_[waves]; /* rad/s */
    double phase_[waves];     /* rad */
};

} // namespace sim
#endif
