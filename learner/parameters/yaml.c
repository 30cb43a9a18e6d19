#include "learner/parameters/yaml.h"

#include <stdio.h>

static const struct option_row rows[] = {LEARNER_OPTION_ROWS, OPTION_END};

double *learner_options_array(const struct option_row *row, struct learner_config *config, int *n)
{
    *n = config->n_inputs;
    switch (row->offset) {
    case offsetof(struct learner_options, reference):
        return config->reference;
    case offsetof(struct learner_options, scale):
        return config->scale;
    case offsetof(struct learner_options, sigma0):
        return config->sigma0;
    case offsetof(struct learner_options, norm_out):
        *n = config->n_outputs;
        return config->lwpr.norm_out;
    default:
        *n = config->n_outputs;
        return config->psi0;
    }
}

struct learner_options learner_options_default(enum learner_kind kind, int n_inputs, int n_outputs)
{
    struct option_list one = {.n = 1, .value = {1}};
    struct option_list unused = {.n = kind == LEARNER_IMLE ? 0 : 1, .value = {1}};
    struct learner_options options = {.config = learner_config_default(n_inputs, n_outputs),
                                      .reference = {.n = 1},
                                      .scale = one,
                                      .psi0 = unused,
                                      .sigma0 = unused,
                                      .norm_out = one};

    options.config.kind = kind;
    return options;
}

/* Copies what people wrote into the configuration's arrays. */
static int spread_lists(struct learner_options *options, char *error, size_t error_size)
{
    for (const struct option_row *row = rows; row->name; row++) {
        const struct option_list *list = (const void *)((const char *)options + row->offset);
        int n;
        if (row->type != OPTION_SPREAD)
            continue;
        double *array = learner_options_array(row, &options->config, &n);
        if (list->n == 0) {
            snprintf(error, error_size, "%s must be given (%s)", row->name, row->help);
            return -1;
        }
        if (list->n != 1 && list->n != n) {
            snprintf(error, error_size, "%s has %d entries; wanted: %d, or one number for all",
                     row->name, list->n, n);
            return -1;
        }
        for (int i = 0; i < n; i++)
            array[i] = list->value[list->n == 1 ? 0 : i];
    }
    return 0;
}

int learner_options_finish(struct learner_options *options, char *error, size_t error_size)
{
    return spread_lists(options, error, error_size)
               ? -1
               : learner_config_check(&options->config, error, error_size);
}
