/* When: the grid of real time, or lockstep with a simulator. Runs in a thread of its own. */
#ifndef REACH_DAEMON_REALTIME_LOOP_H
#define REACH_DAEMON_REALTIME_LOOP_H

#include "daemon/bus/bus.h"
#include "daemon/config/config.h"
#include "daemon/control/tick.h"
#include "daemon/realtime/loop_wait.h"
#include "daemon/realtime/watchdog.h"

#include <stdbool.h>
#include <stdint.h>

struct loop;

size_t loop_memory(void);

/* Everything is owned by the caller or the arena. Returns NULL when the arena is full. */
struct loop *loop_create(const struct config *config, struct tick *tick, struct daemon_bus *bus,
                         struct watchdog *watchdog, bool lockstep, bool real_time,
                         struct arena *arena);

/* Starts the thread, which confines itself to few system calls (confine.h). With `real_time` it
 * asks for SCHED_FIFO and locked memory, and fails when the system refuses them. Returns 0, or -1
 * with one line in `error`. */
int loop_start(struct loop *loop, char *error, size_t error_size);

/* Puts a configuration, which stays the caller's, where the loop takes it before its next tick;
 * NULL takes an offer back. Returns the offer before, if the loop has not taken it; else NULL, and
 * then the loop works with that offer. */
const struct config *loop_offer_config(struct loop *loop, const struct config *config);

/* Ends the thread after the tick it is in; a last command of zero velocity goes out. Returns false
 * when the thread stands still, and has not ended after so many seconds. */
bool loop_stop(struct loop *loop, double seconds);

int64_t loop_ticks(const struct loop *loop);

enum loop_wait loop_waits(const struct loop *loop);

#endif
