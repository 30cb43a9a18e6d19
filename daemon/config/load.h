/* Loading a configuration: rows, what follows from them, the checks, all of it or nothing. */
#ifndef REACH_DAEMON_CONFIG_LOAD_H
#define REACH_DAEMON_CONFIG_LOAD_H

#include "daemon/config/config.h"

#include <stddef.h>

/* Reads the YAML files, a later one over an earlier one, then the overrides "name=value"; checks
 * each option and checks them against each other.
 *   returns 0, or -1 with one line in `error`. */
int config_load(struct config *config, const char *const *paths, int n_paths,
                const char *const *overrides, int n_overrides, char *error, size_t error_size);

/* The same while the daemon runs, with `running`. What babbling may change does not move the middle
 * about which the learner was made. */
int config_load_again(struct config *config, const struct config *running, const char *const *paths,
                      int n_paths, const char *const *overrides, int n_overrides, char *error,
                      size_t error_size);

/* Loads what config_text() gave. Returns 0, or -1 with one line in `error`. The text is taken
 * apart.
 */
int config_from_text(struct config *config, char *text, char *error, size_t error_size);

#endif
