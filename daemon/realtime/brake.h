/* The way out when the loop stands still: commands that fall to zero, past everything that may be
 * held by somebody. Nothing here takes a lock, memory, a pipe or LCM: tools/dev/loop_stack.py shows
 * what brake_step can reach. Plain data; the watchdog's. */
#ifndef REACH_DAEMON_REALTIME_BRAKE_H
#define REACH_DAEMON_REALTIME_BRAKE_H

#include "common/bus/direct.h"
#include "daemon/config/config.h"

#include <reach_robot_command_t.h>
#include <stdbool.h>

struct brake {
    const struct config *config;
    struct bus_direct way;
    bool any;                      /* whether there is a command to brake from */
    reach_robot_command_t command; /* the newest that went out */
};

/* Opens its socket to the bus at `url`. Returns 0, or -1 with one line in `error`. `config` stays
 * the caller's. */
int brake_open(struct brake *brake, const struct config *config, const char *url, char *error,
               size_t error_size);

/* What the loop has sent. */
void brake_follow(struct brake *brake, const reach_robot_command_t *command);

/* Sends a command that is slower by as much as the gate's acceleration allows in a period. Returns
 * false when none was ever sent: there is nothing to brake. */
bool brake_step(struct brake *brake);

/* Whether the newest command is rest. */
bool brake_at_rest(const struct brake *brake);

void brake_close(struct brake *brake);

#endif
