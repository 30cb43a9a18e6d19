/* The two clocks of the loop, which say when a step is: the grid of real time, or the simulator. */
#ifndef REACH_DAEMON_REALTIME_CLOCK_H
#define REACH_DAEMON_REALTIME_CLOCK_H

#include "daemon/realtime/step.h"

/* Step after step, until the loop is to end. For the loop thread. */
void clock_run_lockstep(struct step *step);
void clock_run_real_time(struct step *step);

#endif
