/* Which options may change while the daemon runs.
 *
 * Gains, wanted limits and behaviours may change from one tick to the next. What memory, model or
 * safety were built on may not; an option is of that kind unless reloadable.c names it. */
#ifndef REACH_DAEMON_CONFIG_RELOADABLE_H
#define REACH_DAEMON_CONFIG_RELOADABLE_H

#include "daemon/config/config.h"

#include <stdbool.h>
#include <stddef.h>

/* Whether the loop may go over from one configuration to the other. Counts in `changes` what
 * differs; false with one line in `error` that names the option that forbids it. */
bool config_reloadable(const struct config *from, const struct config *to, int *changes,
                       char *error, size_t error_size);

#endif
