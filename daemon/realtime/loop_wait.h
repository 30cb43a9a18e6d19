/* What the loop is doing, for the thread that keeps house. */
#ifndef REACH_DAEMON_REALTIME_LOOP_WAIT_H
#define REACH_DAEMON_REALTIME_LOOP_WAIT_H

enum loop_wait {
    LOOP_RUNS,
    LOOP_WAITS_FOR_STATE,       /* lockstep: the simulator holds the clock */
    LOOP_WAITS_FOR_OBSERVATION, /* lockstep: vision or the robot has not told yet */
};

#endif
