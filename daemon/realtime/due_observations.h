/* Lockstep: which observations belong to a state. Plain data; used by the loop thread alone.
 *
 * A state names the instant of the observation that is due with it. Later ones wait, so that a run
 * does not depend on how fast vision is; a missing one is waited for, so that it does not depend on
 * what the bus lost: the simulator asks again for it. They may come again, or out of order. */
#ifndef REACH_DAEMON_REALTIME_DUE_OBSERVATIONS_H
#define REACH_DAEMON_REALTIME_DUE_OBSERVATIONS_H

#include "daemon/control/senses/observation.h"
#include "daemon/control/tick.h"

#include <stdbool.h>
#include <stdint.h>

struct due_observations {
    int64_t newest; /* of the newest one handed on, us */
    int n;          /* that wait */
    struct observation waiting[TICK_MAX_OBSERVATIONS];
};

void due_observations_init(struct due_observations *observations);

/* Keeps an observation until it is due. Repeats are ignored; when there is no room the latest one
 * goes, which the simulator will ask for when it is due. */
void due_observations_add(struct due_observations *observations,
                          const struct observation *observation);

/* Whether the observation of `due` (us, 0 = none) is here or was handed on already. */
bool due_observations_ready(const struct due_observations *observations, int64_t due);

/* Hands on the oldest one up to `due`. Returns false when there is none. */
bool due_observations_take(struct due_observations *observations, int64_t due,
                           struct observation *observation);

#endif
