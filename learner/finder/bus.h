/* The finder's side of the LCM bus: a thread that receives, so that a request is answered at once
 * while another is searched for. Of each who asks (learner/bus/finder_channels.h) only the newest
 * request waits: what came before it is of less samples. */
#ifndef REACH_LEARNER_FINDER_BUS_H
#define REACH_LEARNER_FINDER_BUS_H

#include "learner/finder/question.h"

#include <lcm/lcm.h>
#include <reach_body_t.h>
#include <stdint.h>

struct finder_bus;

/* Subscribes on `lcm`, which stays the caller's. `arrived` is called by the receiving thread for
 * each request that waits. NULL with one line in `error`. */
struct finder_bus *finder_bus_create(lcm_t *lcm, void (*arrived)(void), char *error,
                                     size_t error_size);

/* The receiving thread. Returns 0, or -1 with one line in `error`. */
int finder_bus_start(struct finder_bus *bus, char *error, size_t error_size);
/* Ends and joins it, and frees. */
void finder_bus_stop(struct finder_bus *bus);

/* The request that waits, now the caller's; NULL when there is none. Asked for again, it is only
 * told that it is being searched for, and later the answer. */
struct question *finder_bus_take(struct finder_bus *bus);

/* Sends the answer to what was taken; fills in whose it is and when. */
void finder_bus_answer(struct finder_bus *bus, reach_body_t *answer);

/* Messages that were refused. */
int64_t finder_bus_refused(const struct finder_bus *bus);

#endif
