/* What follows from the rows of the configuration. */
#ifndef REACH_DAEMON_CONFIG_DERIVED_H
#define REACH_DAEMON_CONFIG_DERIVED_H

#include "daemon/config/config.h"

/* Sets the task space and the babble range from the rows, which need not fit together yet. */
void config_derive(struct config *config);

#endif
