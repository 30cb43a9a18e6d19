/* The learner's options (learner/parameters/yaml.h) as reach-eval takes them: from YAML files and
 * as "name=value"; printed, and as JSON. */
#ifndef REACH_TOOLS_MEASURE_LEARNER_OPTIONS_H
#define REACH_TOOLS_MEASURE_LEARNER_OPTIONS_H

#include <stddef.h>
#include <stdio.h>

#include "learner/learner.h"
#include "tools/measure/json.h"

#ifdef __cplusplus
extern "C" {
#endif

struct learner_sources {
    enum learner_kind kind;
    int n_inputs;
    int n_outputs;
    const char *const *files; /* YAML, a later one over an earlier one */
    int n_files;
    const char *const *params; /* "name=value", over the files */
    int n_params;
};

/* Fills and checks a configuration.
 *   returns 0, or -1 with one line in `error`: file, line, name and reason */
int learner_options_load(const struct learner_sources *sources, struct learner_config *config,
                         char *error, size_t error_size);

/* The configuration that ships for a robot with these dimensions, or NULL; valid until the next
 * call. */
const char *learner_options_shipped(enum learner_kind kind, int n_inputs, int n_outputs);

/* Every option: name, meaning, default for these dimensions. */
void learner_options_print(enum learner_kind kind, int n_inputs, int n_outputs, FILE *out);

/* One entry a parameter; arrays in full, infinity as the text ".inf". */
void learner_options_to_json(const struct learner_config *config, struct json *json);

#ifdef __cplusplus
}
#endif
#endif
