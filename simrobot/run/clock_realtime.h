/* The real-time clock: physics and states on the absolute grid of the wall clock, whatever the
 * daemon does, as a real robot's drivers would. */
#ifndef SIMROBOT_RUN_CLOCK_REALTIME_H
#define SIMROBOT_RUN_CLOCK_REALTIME_H

#include "simrobot/run/session.h"

namespace sim
{

/* Runs until QUIT or until `stopping` says so.
 *   returns false with one line in `error` when the bus fails. */
bool realtime_run(const Config &config, Session &session, SimBus &bus, bool (*stopping)(),
                  std::string *error);

} // namespace sim
#endif
