/* The learner's parameters: defaults, ranges, and the hash that ties a saved state to them. */
#include <math.h>

#include "learner/base/hash.h"
#include "learner/base/ranges.h"
#include "learner/kind.h"
#include "learner/parameters/rows.h"

struct learner_config learner_config_default(int n_inputs, int n_outputs)
{
    double two_to_d = ldexp(1.0, n_inputs);
    struct learner_config config = {
        .kind = LEARNER_IMLE,
        .n_inputs = n_inputs,
        .n_outputs = n_outputs,
        .capacity = 256,
        .most_bytes = INFINITY,
        .features = LEARNER_LINEAR,
        .degree = 3,
        .alpha = 0.999,
        .hyper_sigma = two_to_d,
        .hyper_psi = 2.0 * n_outputs,
        .prior_sigma = two_to_d,
        .prior_psi = two_to_d,
        .ridge = 0.1,
        .prior_floor = 0.01,
        .n_outliers = 1,
        .p0 = 0.1,
        .skip = 1e-6,
        .n_solutions_max = LEARNER_MAX_SOLUTIONS,
        .clustering = LEARNER_CLUSTER_PUBLISHED,
        .significance = 0.99,
        .leader_level = 0.9,
        .kappa = 0.5,
        .noise_share = 1.0,
        .em_pred_iterations = 2,
        .lwpr = learner_lwpr_default(n_inputs),
        .body = {.space = LEARNER_BODY_PLACE, .starts = 40},
    };

    for (int i = 0; i < LEARNER_MAX_INPUTS; i++)
        config.scale[i] = 1.0;
    for (int i = 0; i < LEARNER_MAX_INPUTS; i++)
        config.body.order[i] = i;
    return config;
}

/* Every row that is one number: the range that people are told of holds for programs, too. */
#define ROW(name, type, field, minimum, maximum, choices, help)                                    \
    {                                                                                              \
        name, type, offsetof(struct learner_config, field), NULL, NULL, minimum, maximum, help,    \
            choices                                                                                \
    }
static const struct option_row rows[] = {LEARNER_ROWS(ROW), OPTION_END};
#undef ROW

static double last_choice(const char *choices)
{
    double last = 0.0;

    for (; *choices; choices++)
        last += *choices == '|';
    return last;
}

static struct learner_range range_of(const struct option_row *row,
                                     const struct learner_config *config)
{
    const void *field = (const char *)config + row->offset;

    switch (row->type) {
    case OPTION_NUMBER:
        return (struct learner_range){row->name, *(const double *)field, row->minimum,
                                      row->maximum};
    case OPTION_INT:
        return (struct learner_range){row->name, *(const int *)field, row->minimum, row->maximum};
    case OPTION_CHOICE:
        return (struct learner_range){row->name, *(const int *)field, 0.0,
                                      last_choice(row->choices)};
    default: /* nothing to be out of range */
        return (struct learner_range){row->name, 0.0, 0.0, 0.0};
    }
}

static int check_rows(const struct learner_config *config, char *err, size_t err_size)
{
    for (const struct option_row *row = rows; row->name; row++) {
        struct learner_range range = range_of(row, config);
        if (learner_check_ranges(&range, 1, err, err_size) != 0)
            return -1;
    }
    return 0;
}

/* What depends on the dimensions, and those. */
static int check_dimensions(const struct learner_config *config, char *err, size_t err_size)
{
    const struct learner_range ranges[] = {
        {"kind", (int)config->kind, LEARNER_IMLE, LEARNER_LWPR},
        {"n_inputs", config->n_inputs, 1, LEARNER_MAX_INPUTS},
        {"n_outputs", config->n_outputs, 1, LEARNER_MAX_OUTPUTS},
        {"prior_sigma", config->prior_sigma, config->n_inputs, INFINITY},
    };

    return LEARNER_CHECK_RANGES(ranges, err, err_size);
}

static int check_scales(const struct learner_config *config, char *err, size_t err_size)
{
    for (int i = 0; i < config->n_inputs; i++) {
        const struct learner_range ranges[] = {
            {"reference", config->reference[i], -LEARNER_LARGEST_NUMBER, LEARNER_LARGEST_NUMBER},
            {"scale", config->scale[i], 1e-9, LEARNER_LARGEST_NUMBER},
        };
        if (LEARNER_CHECK_RANGES(ranges, err, err_size) != 0)
            return -1;
    }
    return 0;
}

int learner_config_check(const struct learner_config *config, char *err, size_t err_size)
{
    if (check_dimensions(config, err, err_size) != 0 || check_rows(config, err, err_size) != 0 ||
        check_scales(config, err, err_size) != 0)
        return -1;
    return learner_ops_of(config)->check(config, err, err_size);
}

uint64_t learner_config_hash(const struct learner_config *config)
{
    const struct learner_ops *ops = learner_ops_of(config);
    const double numbers[] = {
        (double)ops->number,
        config->n_inputs,
        config->n_outputs,
        (int)config->features,
        config->features == LEARNER_LINEAR ? 1 : config->degree,
        config->alpha,
        config->hyper_sigma,
        config->hyper_psi,
        config->prior_sigma,
        config->prior_nu,
        config->prior_psi,
        config->ridge,
        config->prior_floor,
    };
    uint64_t hash = learner_hash(LEARNER_HASH_START, numbers, sizeof numbers);
    size_t inputs = (size_t)config->n_inputs * sizeof(double);

    hash = learner_hash(hash, config->reference, inputs);
    hash = learner_hash(hash, config->scale, inputs);
    return ops->hash(config, hash);
}
