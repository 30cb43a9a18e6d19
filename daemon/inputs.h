/* What may come in: pure checks of messages against the configuration and against sense.
 *
 * A message that fails is dropped and counted; the last good one is kept until it is stale. */
#ifndef REACH_INPUTS_H
#define REACH_INPUTS_H

#include "config.h"

#include <reach_marker_t.h>
#include <reach_request_t.h>
#include <reach_robot_state_t.h>
#include <stdbool.h>

/* The robot's joints: as many as configured, finite, not absurdly beyond their range. */
bool inputs_state_ok(const struct config *config, const reach_robot_state_t *state);

/* A marker: finite, and inside any image that could be. */
bool inputs_marker_ok(const reach_marker_t *marker);

/* The values of a request: counts, targets, period. Whether it fits the daemon's state is not
 * looked at. */
bool inputs_request_ok(const reach_request_t *request);

#endif
