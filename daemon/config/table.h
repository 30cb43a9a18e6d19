/* The rows of the configuration: one for each option. */
#ifndef REACH_DAEMON_CONFIG_TABLE_H
#define REACH_DAEMON_CONFIG_TABLE_H

#include "daemon/config/config.h"

#include <stdio.h>

/* Ends with a row without a name. */
const struct option_row *config_table(void);

/* All zero, but for what the learner's rows hold where no file names them: its own defaults for the
 * Kobian's sizes, with experts that span the workspace, so that a tool is an expert. What follows
 * from the robot comes on top (defaults.h). */
void config_preset(struct config *config);

/* The reference of the options, for --help-options. */
void config_print_options(FILE *out);

#endif
