/* What the service manager hears of the daemon: that it is ready, that its loop advances, and a
 * line on how it goes. For the thread that keeps house. */
#ifndef REACH_DAEMON_HOUSEKEEPING_SERVICE_MANAGER_H
#define REACH_DAEMON_HOUSEKEEPING_SERVICE_MANAGER_H

#include "common/program/notify.h"

#include <reach_status_t.h>
#include <stdbool.h>
#include <stdint.h>

struct service_manager {
    struct notify_watchdog watchdog;
    int64_t ticks; /* at the last look */
    int64_t told;  /* when the last line went out, monotonic us */
};

/* The loop runs: READY=1. */
void service_manager_begin(struct service_manager *manager);

/* To be called often. Feeds the manager's watchdog when `ticks` has moved, or `waits`: in lockstep
 * a loop stands rightly while the simulator holds the clock. Sends a line on `status`, NULL when
 * there is none, at most once a second. `now` is monotonic, us. */
void service_manager_tell(struct service_manager *manager, int64_t now, int64_t ticks, bool waits,
                          const reach_status_t *status);

/* The daemon has begun to end. */
void service_manager_end(void);

#endif
