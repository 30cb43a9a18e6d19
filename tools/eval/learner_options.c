#include "tools/eval/learner_options.h"

#include <math.h>

#include "daemon/learner_rows.h"

/* What the table fills: the configuration, and arrays as people write them. */
struct options {
    struct learner_config config;
    struct option_list reference, scale, psi0, sigma0, norm_out;
};

#define SHARED(name, type, field, minimum, maximum, choices, help)                                 \
    {                                                                                              \
        name, type, offsetof(struct options, config.field), NULL, option_preset, minimum, maximum, \
            help, choices                                                                          \
    }
#define SPREAD(name, list, help)                                                                   \
    {                                                                                              \
        name, OPTION_SPREAD, offsetof(struct options, list), NULL, option_preset, 0, 0, help, NULL \
    }

static const struct option_row rows[] = {
    LEARNER_ROWS(SHARED),
    SPREAD("reference", reference, "c, middle of the inputs' range, where polynomials are centred"),
    SPREAD("scale", scale, "s, unit of the inputs in polynomials"),
    SPREAD("psi0", psi0, "Psi_0, variance of each output about an expert (unit squared)"),
    SPREAD("sigma0", sigma0, "sigma_0, variance of an expert's inputs (unit squared)"),
    SPREAD("lwpr.norm_out", norm_out, "LWPR: unit of each output in the metric's cost"),
    OPTION_END,
};

/* Where the numbers of a SPREAD row live in a configuration, and how many there are. */
static double *array_of(const struct option_row *row, struct learner_config *config, int *n)
{
    *n = config->n_inputs;
    switch (row->offset) {
    case offsetof(struct options, reference):
        return config->reference;
    case offsetof(struct options, scale):
        return config->scale;
    case offsetof(struct options, sigma0):
        return config->sigma0;
    case offsetof(struct options, norm_out):
        *n = config->n_outputs;
        return config->lwpr.norm_out;
    default:
        *n = config->n_outputs;
        return config->psi0;
    }
}

/* What holds where nobody says otherwise. Psi_0 and sigma_0 have no default (an empty list), except
 * for a learner that does not use them. */
static struct options defaults(enum learner_kind kind, int n_inputs, int n_outputs)
{
    struct option_list one = {.n = 1, .value = {1}};
    struct option_list unused = {.n = kind == LEARNER_IMLE ? 0 : 1, .value = {1}};
    struct options options = {.config = learner_config_default(n_inputs, n_outputs),
                              .reference = {.n = 1},
                              .scale = one,
                              .psi0 = unused,
                              .sigma0 = unused,
                              .norm_out = one};

    options.config.kind = kind;
    return options;
}

/* Copies what people wrote into the configuration's arrays. */
static int spread(struct options *options, char *error, size_t error_size)
{
    for (const struct option_row *row = rows; row->name; row++) {
        const struct option_list *list = (const void *)((const char *)options + row->offset);
        int n;
        if (row->type != OPTION_SPREAD)
            continue;
        double *array = array_of(row, &options->config, &n);
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

int learner_options_load(const struct learner_sources *sources, struct learner_config *config,
                         char *error, size_t error_size)
{
    struct options options = defaults(sources->kind, sources->n_inputs, sources->n_outputs);
    char reason[256];

    if (options_load_as(rows, &options, sources->files, sources->n_files, "--param",
                        sources->params, sources->n_params, error, error_size))
        return -1;
    if (spread(&options, reason, sizeof reason) ||
        learner_config_check(&options.config, reason, sizeof reason)) {
        snprintf(error, error_size, "%s: %s",
                 sources->n_params > 0  ? "--param"
                 : sources->n_files > 0 ? sources->files[sources->n_files - 1]
                                        : "--learner",
                 reason);
        return -1;
    }
    *config = options.config;
    return 0;
}

const char *learner_options_shipped(enum learner_kind kind, int n_inputs, int n_outputs)
{
    static const struct {
        enum learner_kind kind;
        int n_inputs;
        const char *path;
    } shipped[] = {
        {LEARNER_IMLE, 7, REACH_ETC_DIR "/learner-icub.yaml"},
        {LEARNER_IMLE, 4, REACH_ETC_DIR "/learner-kobian-offline.yaml"},
        {LEARNER_LWPR, 7, REACH_ETC_DIR "/learner-icub-lwpr.yaml"},
        {LEARNER_LWPR, 4, REACH_ETC_DIR "/learner-kobian-offline-lwpr.yaml"},
    };

    for (size_t i = 0; i < sizeof shipped / sizeof shipped[0] && n_outputs == 3; i++)
        if (shipped[i].kind == kind && shipped[i].n_inputs == n_inputs)
            return shipped[i].path;
    return NULL;
}

void learner_options_print(enum learner_kind kind, int n_inputs, int n_outputs, FILE *out)
{
    struct options options = defaults(kind, n_inputs, n_outputs);

    options_print(rows, &options, out);
}

static void row_to_json(const struct option_row *row, struct options *options, struct json *json)
{
    const void *field = (const char *)options + row->offset;
    char text[OPTION_TEXT_SIZE];
    int n;

    if (row->type == OPTION_BOOL) {
        json_bool(json, row->name, *(const bool *)field);
    } else if (row->type == OPTION_SPREAD) {
        const double *array = array_of(row, &options->config, &n);
        json_numbers(json, row->name, n, array);
    } else if (row->type == OPTION_INT) {
        json_number(json, row->name, *(const int *)field);
    } else if (row->type == OPTION_NUMBER && isfinite(*(const double *)field)) {
        json_number(json, row->name, *(const double *)field);
    } else {
        option_text(row, options, text);
        json_text(json, row->name, text);
    }
}

void learner_options_to_json(const struct learner_config *config, struct json *json)
{
    struct options options = {.config = *config};

    for (const struct option_row *row = rows; row->name; row++)
        row_to_json(row, &options, json);
}
