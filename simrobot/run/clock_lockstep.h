/* The lockstep clock: one state, one command, one period of physics; as fast as the others answer,
 * and the same in every run. */
#ifndef SIMROBOT_RUN_CLOCK_LOCKSTEP_H
#define SIMROBOT_RUN_CLOCK_LOCKSTEP_H

#include "simrobot/run/session.h"

namespace sim
{

/* Runs until QUIT or until `stopping` says so.
 *   returns false with one line in `error` when the bus fails. */
bool lockstep_run(const Config &config, Session &session, SimBus &bus, bool (*stopping)(),
                  std::string *error);

} // namespace sim
#endif
