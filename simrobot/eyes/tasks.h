/* What can be asked of the eyes without a bus: one picture, and how long pictures take. */
#ifndef SIMROBOT_EYES_TASKS_H
#define SIMROBOT_EYES_TASKS_H

#include "simrobot/world/simulation.h"

namespace sim
{

/* Writes what both eyes see now, side by side, as a PPM picture; of a robot without eyes, how it
 * looks to somebody beside it.
 *   returns false with one line in `error`. */
bool eye_task_snapshot(const Config &config, const Simulation &simulation, uint64_t seed,
                       const std::string &path, std::string *error);

/* Draws and encodes `count` pairs and prints the time of each part.
 *   returns false with one line in `error`. */
bool eye_task_bench(const Config &config, Simulation &simulation, uint64_t seed, int64_t count,
                    std::string *error);

} // namespace sim
#endif
