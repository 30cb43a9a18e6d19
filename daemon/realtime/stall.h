/* Whether a loop stands still, judged by its heartbeat. Pure: time is an argument. */
#ifndef REACH_DAEMON_REALTIME_STALL_H
#define REACH_DAEMON_REALTIME_STALL_H

#include <stdbool.h>
#include <stdint.h>

struct stall {
    int64_t beats;  /* newest count that was seen */
    int64_t moved;  /* when it was first seen, us */
    int64_t looked; /* the look before, us; 0 = none yet */
};

/* One look at `now` (monotonic, us): true when the heartbeat has not moved for `patience` us. A
 * watch that itself did not get to look for half of that (the whole process was stopped, the
 * machine slept) cannot know who is to blame, and begins to measure anew. */
static inline bool stall_seen(struct stall *stall, int64_t beats, int64_t patience, int64_t now)
{
    bool blind = stall->looked == 0 || now - stall->looked > patience / 2;

    stall->looked = now;
    if (blind || beats != stall->beats) {
        stall->beats = beats;
        stall->moved = now;
    }
    return now - stall->moved > patience;
}

#endif
