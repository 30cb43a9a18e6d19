/* What a sense has told of the end-effector at one instant, whichever sense it is: of a MARKER
 * [u_R, v_R, u_L - u_R] in px, of an END_EFFECTOR its position in m. Plain data. */
#ifndef REACH_DAEMON_CONTROL_SENSES_OBSERVATION_H
#define REACH_DAEMON_CONTROL_SENSES_OBSERVATION_H

#include "daemon/config/space.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct observation {
    int64_t utime; /* exposure or measurement, us */
    int64_t seq;   /* of the message */
    int8_t seen;   /* 0: looked for and not found; `value` then means nothing */
    double value[SPACE_DIMENSIONS];
    uint32_t checksum; /* of the message, as trace_t wants it */
};

/* Whether the task space could have this, seen or wanted: finite, and not absurdly far. */
static inline bool observation_is_sensible(const struct space *space,
                                           const double value[SPACE_DIMENSIONS])
{
    /* Written so that a NaN fails. */
    for (int axis = 0; axis < SPACE_DIMENSIONS; axis++)
        if (!(fabs(value[axis]) <= space->largest))
            return false;
    return true;
}

#endif
