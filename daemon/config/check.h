/* Whether the options of a configuration, each within its own range, fit together. */
#ifndef REACH_DAEMON_CONFIG_CHECK_H
#define REACH_DAEMON_CONFIG_CHECK_H

#include "daemon/config/config.h"

#include <stddef.h>

/* Returns 0, or -1 with one line in `error` that names the options. */
int config_check(const struct config *config, char *error, size_t error_size);

#endif
