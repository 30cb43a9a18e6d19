#include "tools/eval/learner_options.h"

#include <math.h>
#include <string.h>

#include "common/options.h"

/* What the table fills: the configuration, and arrays as people write them. */
struct options {
    struct learner_config config;
    struct option_list reference, scale, psi0, sigma0, norm_out;
};

#define ROW(name, type, help)                                                                      \
    {                                                                                              \
#name, type, offsetof(struct options, config.name), NULL, NULL, 0, 0, help, NULL           \
    }
#define COUNT(name, help) ROW(name, OPTION_INT, help)
#define NUMBER(name, help) ROW(name, OPTION_NUMBER, help)
#define FLAG(name, help) ROW(name, OPTION_BOOL, help)
#define CHOICE(name, words, help)                                                                  \
    {                                                                                              \
#name, OPTION_CHOICE, offsetof(struct options, config.name), NULL, NULL, 0, 0, help, words \
    }
#define SPREAD_AT(name, list, help)                                                                \
    {                                                                                              \
#name, OPTION_SPREAD, offsetof(struct options, list), NULL, NULL, 0, 0, help, NULL         \
    }
#define SPREAD(name, help) SPREAD_AT(name, name, help)

/* Defaults are put in by fill_table(); ranges are learner_config_check()'s. */
static const struct option_row rows[] = {
    COUNT(capacity, "most experts"),
    NUMBER(most_bytes, "memory that may lower the capacity"),
    CHOICE(features, "linear|polynomial", "what an expert is linear in: inputs or monomials"),
    COUNT(degree, "of the polynomial"),
    SPREAD(reference, "c, middle of the inputs' range, where polynomials are centred"),
    SPREAD(scale, "s, unit of the inputs in polynomials"),
    SPREAD(psi0, "Psi0, variance of each output about an expert (unit squared)"),
    SPREAD(sigma0, "variance of an expert's inputs (unit squared)"),
    NUMBER(alpha, "forgetting exponent, 1 = none"),
    NUMBER(hyper_sigma, "w_sigma, strength of sigma0"),
    NUMBER(hyper_psi, "w_psi, strength of psi0"),
    NUMBER(prior_sigma, "w_Sigma, strength of an expert's input prior"),
    NUMBER(prior_nu, "w_nu, prior on an expert's centre"),
    NUMBER(prior_psi, "w_Psi, strength of an expert's noise prior; .inf: psi0 always"),
    NUMBER(ridge, "w_Lambda, prior on the slopes"),
    NUMBER(prior_floor, "least share of the priors left by forgetting"),
    COUNT(n_outliers, "outliers in a row that are dropped before a birth"),
    NUMBER(p0, "outlier probability"),
    FLAG(inherit, "a newborn starts from its parent's slopes"),
    NUMBER(skip, "responsibilities under this are not learned"),
    COUNT(n_solutions_max, "most solutions of a prediction"),
    CHOICE(clustering, "published|split|leader", "how experts are gathered into solutions"),
    NUMBER(significance, "level of the rules that split"),
    NUMBER(leader_level, "level of the leader rule"),
    NUMBER(kappa, "exponent of distance in the rules split and leader"),
    COUNT(em_pred_iterations, "of the rules that split"),
    NUMBER(noise_share, "variance of the samples' noise, in units of Psi; 1 = as published"),
    NUMBER(gamma_floor, "least uncertainty of an expert in an average, 0 = as published"),
    FLAG(average_jacobian, "mean of slopes instead of the exact derivative"),
    CHOICE(kernels, "auto|plain|avx2|avx512", "vector width; all give the same bits"),
    NUMBER(lwpr.init_d, "LWPR: metric of a new receptive field, per square of scale"),
    FLAG(lwpr.diagonal_only, "LWPR: metrics stay diagonal"),
    NUMBER(lwpr.init_alpha, "LWPR: learning rate of the metric"),
    NUMBER(lwpr.penalty, "LWPR: on large metrics"),
    NUMBER(lwpr.w_gen, "LWPR: activation under which a sample gets a field of its own"),
    NUMBER(lwpr.w_prune, "LWPR: activation of two fields at which one goes"),
    NUMBER(lwpr.cutoff, "LWPR: activation under which a field takes no part"),
    NUMBER(lwpr.add_threshold, "LWPR: share of the error under which a projection is added"),
    COUNT(lwpr.max_projections, "LWPR: most projections of a field"),
    NUMBER(lwpr.init_lambda, "LWPR: forgetting factor of a new projection, 1 = none"),
    NUMBER(lwpr.final_lambda, "LWPR: forgetting factor in the end"),
    NUMBER(lwpr.tau_lambda, "LWPR: how slowly one goes to the other"),
    NUMBER(lwpr.init_s2, "LWPR: what a projection's sum of squares begins with"),
    SPREAD_AT(lwpr.norm_out, norm_out, "LWPR: unit of each output in the metric's cost"),
    OPTION_END,
};

enum { N_ROWS = sizeof rows / sizeof rows[0], TEXT_SIZE = 40 };

/* A table with the defaults for one learner, and the texts that its rows point to. */
struct table {
    struct option_row rows[N_ROWS];
    char initial[N_ROWS][TEXT_SIZE];
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

static void number_text(double value, char text[TEXT_SIZE])
{
    if (isinf(value))
        snprintf(text, TEXT_SIZE, value > 0 ? ".inf" : "-.inf");
    else
        snprintf(text, TEXT_SIZE, "%.12g", value);
}

static void choice_text(const struct option_row *row, int index, char text[TEXT_SIZE])
{
    const char *word = row->choices;

    while (index-- > 0)
        word = strchr(word, '|') + 1;
    snprintf(text, TEXT_SIZE, "%.*s", (int)strcspn(word, "|"), word);
}

/* A scalar of the configuration as YAML would hold it; of an array the first entry. */
static void value_text(const struct option_row *row, struct options *options, char text[TEXT_SIZE])
{
    const void *field = (const char *)options + row->offset;
    int n;

    switch (row->type) {
    case OPTION_BOOL:
        snprintf(text, TEXT_SIZE, *(const bool *)field ? "true" : "false");
        break;
    case OPTION_INT:
        snprintf(text, TEXT_SIZE, "%d", *(const int *)field);
        break;
    case OPTION_CHOICE:
        choice_text(row, *(const int *)field, text);
        break;
    case OPTION_SPREAD:
        number_text(array_of(row, &options->config, &n)[0], text);
        break;
    default:
        number_text(*(const double *)field, text);
        break;
    }
}

/* The two that have no default, except for a learner that does not use them. */
static bool must_be_given(const struct option_row *row, enum learner_kind kind)
{
    return kind == LEARNER_IMLE && (row->offset == offsetof(struct options, psi0) ||
                                    row->offset == offsetof(struct options, sigma0));
}

static struct learner_config defaults(enum learner_kind kind, int n_inputs, int n_outputs)
{
    struct learner_config config = learner_config_default(n_inputs, n_outputs);

    config.kind = kind;
    if (kind != LEARNER_IMLE) {
        for (int i = 0; i < LEARNER_MAX_INPUTS; i++)
            config.sigma0[i] = 1;
        for (int i = 0; i < LEARNER_MAX_OUTPUTS; i++)
            config.psi0[i] = 1;
    }
    return config;
}

static void fill_table(struct table *table, const struct learner_config *config)
{
    struct options options = {.config = *config};

    memcpy(table->rows, rows, sizeof rows);
    for (int i = 0; rows[i].name; i++) {
        value_text(&rows[i], &options, table->initial[i]);
        if (!must_be_given(&rows[i], config->kind))
            table->rows[i].initial = table->initial[i];
    }
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
    struct options options = {.config =
                                  defaults(sources->kind, sources->n_inputs, sources->n_outputs)};
    struct table table;
    char reason[256];

    fill_table(&table, &options.config);
    if (options_load_as(table.rows, &options, sources->files, sources->n_files, "--param",
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
    struct learner_config config = defaults(kind, n_inputs, n_outputs);
    struct table table;

    fill_table(&table, &config);
    options_print(table.rows, out);
}

static void row_to_json(const struct option_row *row, struct options *options, struct json *json)
{
    const void *field = (const char *)options + row->offset;
    char text[TEXT_SIZE];
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
        value_text(row, options, text);
        json_text(json, row->name, text);
    }
}

void learner_options_to_json(const struct learner_config *config, struct json *json)
{
    struct options options = {.config = *config};

    for (const struct option_row *row = rows; row->name; row++)
        row_to_json(row, &options, json);
}
