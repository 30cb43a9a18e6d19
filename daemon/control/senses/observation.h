/* What a sense has told of the end-effector at one instant, whichever sense it is: of a MARKER
 * [u_R, v_R, u_L - u_R] in px, of an END_EFFECTOR its position in m. Plain data. */
#ifndef REACH_DAEMON_CONTROL_SENSES_OBSERVATION_H
#define REACH_DAEMON_CONTROL_SENSES_OBSERVATION_H

#include "daemon/config/space.h"

#include <stdint.h>

struct observation {
    int64_t utime; /* exposure or measurement, us */
    int64_t seq;   /* of the message */
    int8_t seen;   /* 0: looked for and not found; `value` then means nothing */
    double value[SPACE_DIMENSIONS];
    uint32_t checksum; /* of the message, as trace_t wants it */
};

#endif
