/* The daemon's threads: which begins when, and in what order they end so that the arm rests. For
 * the main thread. */
#ifndef REACH_DAEMON_THREADS_H
#define REACH_DAEMON_THREADS_H

#include "daemon/bus/bus.h"
#include "daemon/realtime/loop.h"
#include "daemon/realtime/watchdog.h"
#include "learner/store/disk_thread.h"

#include <stdbool.h>
#include <stddef.h>

struct threads {
    struct daemon_bus *bus;
    struct loop *loop;
    struct watchdog *watchdog;
    struct model_store *store;
    bool real_time;
    struct disk_thread disk;
};

/* Starts all or none. Returns 0, or -1 with one line in `error`. */
int threads_start(struct threads *threads, char *error, size_t error_size);

/* Ends all, at the latest some seconds after the arm rests: the loop first, while the watchdog
 * still looks at it; then the watchdog, which has braked the arm where the loop stood still; the
 * model's thread last, since its disk may be slow. Returns false when the loop stands still for
 * good: the memory that it works with must then be left alone. */
bool threads_stop(struct threads *threads);

#endif
