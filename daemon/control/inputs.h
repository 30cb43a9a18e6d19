/* What may come in: pure checks of messages against the configuration and against sense.
 *
 * A message that fails is dropped and counted; the last good one is kept until it is stale. */
#ifndef REACH_DAEMON_CONTROL_INPUTS_H
#define REACH_DAEMON_CONTROL_INPUTS_H

#include "daemon/config/config.h"
#include "daemon/control/senses/observation.h"
#include "daemon/control/senses/refusals.h"

#include <reach_request_t.h>
#include <reach_robot_state_t.h>
#include <stdbool.h>

/* The robot's joints: as many as configured, finite, not absurdly beyond their range. When they are
 * not, `fault` says what is wrong. */
bool inputs_state_ok(const struct config *config, const reach_robot_state_t *state,
                     struct state_fault *fault);

/* An observation: finite, and where the task space could have it. */
bool inputs_observation_ok(const struct config *config, const struct observation *observation);

/* The kind and the values of a request that starts no behaviour; those that start one are looked at
 * by it (behaviour_ops.accepts). Whether it fits the daemon's state is not looked at. */
bool inputs_request_ok(const reach_request_t *request);

#endif
