#include "tools/measure/learner_options.h"

#include <limits.h>
#include <math.h>

#include "learner/parameters/yaml.h"
#include "tools/measure/etc_directory.h"

static const struct option_row rows[] = {LEARNER_OPTION_ROWS, OPTION_END};

int learner_options_load(const struct learner_sources *sources, struct learner_config *config,
                         char *error, size_t error_size)
{
    struct learner_options options =
        learner_options_default(sources->kind, sources->n_inputs, sources->n_outputs);
    char reason[256];

    if (options_load_as(rows, &options, sources->files, sources->n_files, "--param",
                        sources->params, sources->n_params, error, error_size))
        return -1;
    if (learner_options_finish(&options, reason, sizeof reason)) {
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
        const char *name;
    } shipped[] = {
        {LEARNER_IMLE, 7, "learner-icub.yaml"},
        {LEARNER_IMLE, 4, "learner-kobian-offline.yaml"},
        {LEARNER_LWPR, 7, "learner-icub-lwpr.yaml"},
        {LEARNER_LWPR, 4, "learner-kobian-offline-lwpr.yaml"},
    };
    static char path[PATH_MAX];

    for (size_t i = 0; i < sizeof shipped / sizeof shipped[0] && n_outputs == 3; i++)
        if (shipped[i].kind == kind && shipped[i].n_inputs == n_inputs)
            return etc_file(shipped[i].name, path, sizeof path);
    return NULL;
}

void learner_options_print(enum learner_kind kind, int n_inputs, int n_outputs, FILE *out)
{
    struct learner_options options = learner_options_default(kind, n_inputs, n_outputs);

    options_print(rows, &options, out);
}

static void row_to_json(const struct option_row *row, struct learner_options *options,
                        struct json *json)
{
    const void *field = (const char *)options + row->offset;
    char text[OPTION_TEXT_SIZE];
    int n;

    if (row->type == OPTION_BOOL) {
        json_bool(json, row->name, *(const bool *)field);
    } else if (row->type == OPTION_SPREAD) {
        const double *array = learner_options_array(row, &options->config, &n);
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
    struct learner_options options = {.config = *config};

    for (const struct option_row *row = rows; row->name; row++)
        row_to_json(row, &options, json);
}
