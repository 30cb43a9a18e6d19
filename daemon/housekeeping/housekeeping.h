/* Housekeeping in the main thread: signals, warnings, the service manager. The model has a thread
 * of its own for the disk, disk_thread.h. */
#ifndef REACH_DAEMON_HOUSEKEEPING_HOUSEKEEPING_H
#define REACH_DAEMON_HOUSEKEEPING_HOUSEKEEPING_H

#include "daemon/bus/bus.h"
#include "daemon/housekeeping/reload.h"
#include "daemon/housekeeping/service_manager.h"
#include "daemon/realtime/loop.h"
#include "daemon/realtime/watchdog.h"

#include <stdint.h>

struct housekeeping {
    struct loop *loop;
    struct daemon_bus *bus;
    struct watchdog *watchdog;
    struct reload *reload;
    struct service_manager service_manager;
    reach_status_t status; /* the newest */
    bool any_status;
    int8_t fault;           /* the newest that the log was told of, status_t.FAULT_* */
    reach_status_t refused; /* at which the log was last told what was refused, */
    int64_t refused_said;   /* and when, monotonic us; 0 = never */
    int32_t troubles;       /* of the status before */
    int64_t waiting_since;  /* for a marker that is due, monotonic us; 0 = not waiting */
    int64_t said;           /* when the log was last told of it, monotonic us */
    int64_t announced;      /* when the bus was last told the configuration, monotonic us */
};

/* Blocks the signals that housekeeping_run receives. To be called before any thread starts. */
void housekeeping_take_signals(void);

/* Keeps house until SIGINT or SIGTERM asks to end. */
void housekeeping_run(struct housekeeping *housekeeping);

#endif
