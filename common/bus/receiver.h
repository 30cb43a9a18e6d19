/* The thread that waits on LCM: it runs the handlers of what is subscribed. */
#ifndef REACH_COMMON_BUS_RECEIVER_H
#define REACH_COMMON_BUS_RECEIVER_H

#include <lcm/lcm.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct bus_receiver {
    lcm_t *lcm;
    const char *name;
    _Atomic bool ending;
    pthread_t thread;
    int64_t turned;             /* when it last began to wait, us by the monotonic clock */
    int64_t held_from, held_to; /* when it should have gone on and did not; the same clock */
};

/* Starts it on `lcm`, which stays the caller's, as does `name`, of 15 letters at most; `priority`
 * as thread_start takes it. Returns 0, or -1 with one line in `error`. */
int bus_receiver_start(struct bus_receiver *receiver, lcm_t *lcm, const char *name, int priority,
                       char *error, size_t error_size);

/* The earliest time (us, monotonic) at which the message that a handler has at hand may have come,
 * without the delays of a thread that runs; for handlers alone. A process that was stopped reads
 * what waited as if it were new: liblcm 1.3.1 hands on the kernel's stamp with the first message in
 * each of its buffers, and with later ones the time at which it read them. */
int64_t bus_receiver_arrived(struct bus_receiver *receiver);

/* Ends and joins it: no handler runs any more. */
void bus_receiver_stop(struct bus_receiver *receiver);

#endif
