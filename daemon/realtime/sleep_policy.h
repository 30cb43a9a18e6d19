/* The sleep policy of the real-time loop: stay on the grid, skip whole periods, count. Pure. */
#ifndef REACH_DAEMON_REALTIME_SLEEP_POLICY_H
#define REACH_DAEMON_REALTIME_SLEEP_POLICY_H

#include <stdint.h>

/* The next wake-up after `due`, seen at `now` (ns). A loop that is so late that the next period is
 * over as well skips it rather than hurry after it; *skipped becomes how many periods were. */
static inline int64_t sleep_policy_next(int64_t due, int64_t now, int64_t period, int64_t *skipped)
{
    int64_t next = due + period;

    *skipped = now > next ? (now - due - 1) / period : 0;
    return due + (*skipped + 1) * period;
}

#endif
