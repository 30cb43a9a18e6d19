/* Reading the configuration again while the daemon runs: whole and checked, or not at all. */
#ifndef REACH_DAEMON_HOUSEKEEPING_RELOAD_H
#define REACH_DAEMON_HOUSEKEEPING_RELOAD_H

#include "daemon/bus/bus.h"
#include "daemon/config/config.h"
#include "daemon/realtime/loop.h"

struct reload {
    /* What the daemon was started with; the caller's. */
    const char *const *paths, *const *overrides;
    int n_paths, n_overrides;
    const struct config *accepted; /* newest; at first what the loop was made with */

    /* The rest is reload.c's: while the loop works with one buffer, the other is free. */
    struct config buffer[2];
    struct config read;
    const struct config *used; /* the loop works with this one, as far as housekeeping knows */
};

/* Housekeeping thread: reads all again, says so on the bus and offers it to the loop, which takes
 * it before its next tick; or logs why not, and the old one stays. */
void reload_configuration(struct reload *reload, struct daemon_bus *bus, struct loop *loop);

#endif
