/* Defaults that follow from the robot: from how many joints its arm has and how far they go, and
 * from the task space. They are of the table's rows whose default is preset. */
#ifndef REACH_DAEMON_CONFIG_DEFAULTS_H
#define REACH_DAEMON_CONFIG_DEFAULTS_H

#include "daemon/config/config.h"

/* Sets them in `config` as they are for `robot`, of which the ranges of arm and babbling and
 * task_space count. */
void config_set_defaults(struct config *config, const struct config *robot);

/* What the default of the option `name` follows from, for people; NULL where it is always the same.
 */
const char *config_default_reason(const char *name);

#endif
