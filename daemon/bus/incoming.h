/* Messages that the daemon hears, decoded: from the bus or from a log. Each has a fixed size, and
 * what is longer, shorter or of another type is refused. */
#ifndef REACH_DAEMON_BUS_INCOMING_H
#define REACH_DAEMON_BUS_INCOMING_H

#include "daemon/config/space.h"
#include "daemon/control/senses/observation.h"

#include <reach_request_t.h>
#include <reach_robot_state_t.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

bool incoming_state(const void *data, size_t size, reach_robot_state_t *state);
bool incoming_request(const void *data, size_t size, reach_request_t *request);

/* Of the sense that this task space has, with its checksum. */
bool incoming_observation(enum space_kind space, const void *data, size_t size,
                          struct observation *observation);

/* The channel of that sense. */
const char *incoming_sense(enum space_kind space);

#endif
