/* The configuration of reach-learner: dimensions, the learner's parameters without a prefix, so
 * that the files of reach-eval (etc/learner-*.yaml) serve, and where the model is kept. */
#ifndef REACH_LEARNER_SERVICE_SETTINGS_H
#define REACH_LEARNER_SERVICE_SETTINGS_H

#include "learner/parameters/yaml.h"
#include "learner/store/store.h"

#include <stddef.h>
#include <stdio.h>

struct settings {
    struct learner_options learner; /* the rows of yaml.h want it first */
    int n_inputs, n_outputs;
    int kind; /* enum learner_kind */
    char model_directory[OPTION_MAX_TEXT];
    int model_snapshot;
    double model_snapshot_budget; /* MB a day */
    int model_keep;
    int model_saved_most;
    bool learn_frozen;
};

/* Reads and checks everything.
 *   returns 0, or -1 with one line in `error`: file, line, name and reason */
int settings_load(struct settings *settings, const char *const *paths, int n_paths,
                  const char *const *overrides, int n_overrides, char *error, size_t error_size);

/* Every option with its default, for one input and output; those of the learner that depend on the
 * dimensions say so in docs/learner.md. */
void settings_print(FILE *out);

/* How the model is kept: what is learned goes to disk at once. Points into `settings`. */
struct model_store_settings settings_store(const struct settings *settings);

#endif
