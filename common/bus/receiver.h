/* The thread that waits on LCM: it runs the handlers of what is subscribed. */
#ifndef REACH_COMMON_BUS_RECEIVER_H
#define REACH_COMMON_BUS_RECEIVER_H

#include <lcm/lcm.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

struct bus_receiver {
    lcm_t *lcm;
    const char *name;
    _Atomic bool ending;
    pthread_t thread;
};

/* Starts it on `lcm`, which stays the caller's, as does `name`, of 15 letters at most; `priority`
 * as thread_start takes it. Returns 0, or -1 with one line in `error`. */
int bus_receiver_start(struct bus_receiver *receiver, lcm_t *lcm, const char *name, int priority,
                       char *error, size_t error_size);

/* Ends and joins it: no handler runs any more. */
void bus_receiver_stop(struct bus_receiver *receiver);

#endif
