#include "learner/health/health.h"

#include <math.h>
#include <string.h>

#include "learner/health/judge.h"

enum {
    LEAST_DROPPED = 10,  /* of few samples a share says nothing */
    LEAST_CONSTANT = 50, /* samples in which an input must have stood still */
    LEAST_EXPERTS = 4,   /* one more than a hand and two tools */
    LEAST_PREDICTIONS = 100,
    SAMPLES_POLYNOMIAL = 30, /* that an expert takes until it knows its branch a little */
    SAMPLES_BODY = 8,        /* a tip has some six numbers */
    CHANGES_A_RUN = 10,      /* outputs that repeat more often do so by nature */
};
static const double most_dropped = 0.05;
static const double least_motion = 0.01; /* of an input's range, for it to have moved */
static const double least_range = 1e-3;  /* of its scale, for an input not to be constant */

void health_init(struct health *health, const struct learner_config *config, uint64_t window)
{
    const bool polynomial = config->kind == LEARNER_IMLE && config->features == LEARNER_POLYNOMIAL;
    const bool body = config->kind == LEARNER_IMLE && config->features == LEARNER_BODY;

    *health = (struct health){.has_scale = polynomial || body, .window = window};
    health->n_inputs = config->n_inputs;
    health->n_outputs = config->n_outputs;
    health->least_samples = body ? SAMPLES_BODY : polynomial ? SAMPLES_POLYNOMIAL : 0;
    memcpy(health->reference, config->reference, sizeof health->reference);
    memcpy(health->scale, config->scale, sizeof health->scale);
    health_forget(health);
}

void health_forget(struct health *health)
{
    struct health empty = {.n_inputs = health->n_inputs,
                           .n_outputs = health->n_outputs,
                           .has_scale = health->has_scale,
                           .least_samples = health->least_samples,
                           .names = health->names,
                           .window = health->window};

    memcpy(empty.reference, health->reference, sizeof empty.reference);
    memcpy(empty.scale, health->scale, sizeof empty.scale);
    for (int i = 0; i < LEARNER_MAX_INPUTS; i++)
        empty.input[i] = (struct health_input){.low = INFINITY, .high = -INFINITY};
    *health = empty;
}

static bool all_finite(int n, const double *numbers)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(numbers[i]))
            return false;
    return true;
}

double health_scales(const struct health *health, int input, double value)
{
    return health->has_scale ? fabs(value - health->reference[input]) / health->scale[input] : 0;
}

static void note_inputs(struct health *health, const double *z)
{
    for (int i = 0; i < health->n_inputs; i++) {
        struct health_input *input = &health->input[i];
        double scales = health_scales(health, i, z[i]);
        input->low = fmin(input->low, z[i]);
        input->high = fmax(input->high, z[i]);
        if (scales <= HEALTH_MOST_SCALES)
            continue;
        if (input->far == 0 || scales > health_scales(health, i, input->farthest)) {
            input->farthest = z[i];
            input->farthest_sample = health->seen;
        }
        input->far++;
    }
}

static bool has_moved(const struct health *health, const double *z)
{
    for (int i = 0; i < health->n_inputs; i++)
        if (fabs(z[i] - health->run_z[i]) >
            least_motion * (health->input[i].high - health->input[i].low))
            return true;
    return false;
}

/* Outputs are compared bit for bit: a measurement that is made anew carries new noise. */
static bool stands_still(struct health *health, const double *z, const double *x)
{
    const size_t size = (size_t)health->n_outputs * sizeof *x;

    if (health->seen == 1 || memcmp(x, health->run_x, size) != 0) {
        memcpy(health->run_z, z, (size_t)health->n_inputs * sizeof *z);
        memcpy(health->run_x, x, size);
        health->changes++;
        health->repeats = false;
        return false;
    }
    if (!has_moved(health, z))
        return false;
    health->runs += !health->repeats;
    health->repeats = true;
    return health->runs <= 1 + health->changes / CHANGES_A_RUN;
}

/* Older samples count for less. */
static void fade(struct health *health)
{
    health->samples /= 2;
    health->outliers /= 2;
    health->full /= 2;
    health->frozen /= 2;
    health->predictions /= 2;
    health->solutions /= 2;
    for (int i = 0; i < health->n_inputs; i++)
        health->input[i].far /= 2;
}

bool health_look(struct health *health, const double *z, const double *x)
{
    if (!all_finite(health->n_inputs, z) || !all_finite(health->n_outputs, x))
        return true; /* the learner refuses and counts it */
    if (health->window > 0 && health->samples >= health->window)
        fade(health);
    health->seen++;
    health->samples++;
    note_inputs(health, z);
    if (!stands_still(health, z, x))
        return true;
    if (health->frozen++ == 0)
        health->first_frozen = health->seen;
    return false;
}

void health_count(struct health *health, enum learner_update_result result)
{
    health->outliers += result == LEARNER_OUTLIER;
    health->full += result == LEARNER_FULL;
}

void health_count_solutions(struct health *health, int n_solutions)
{
    health->predictions++;
    health->solutions += (uint64_t)n_solutions;
}

static bool too_many(const struct health *health, uint64_t dropped)
{
    return dropped >= LEAST_DROPPED && (double)dropped > most_dropped * (double)health->samples;
}

bool health_is_constant(const struct health *health, int input)
{
    const struct health_input *range = &health->input[input];
    double least = health->has_scale ? least_range * health->scale[input] : 0;

    return health->seen >= LEAST_CONSTANT && range->high - range->low <= least;
}

static bool is_constant(const struct health *health)
{
    for (int i = 0; i < health->n_inputs; i++)
        if (health_is_constant(health, i))
            return true;
    return false;
}

static bool is_far(const struct health *health)
{
    for (int i = 0; i < health->n_inputs; i++)
        if (health->input[i].far > 0)
            return true;
    return false;
}

int health_farthest(const struct health *health)
{
    int worst = 0;
    double most = 0;

    for (int i = 0; i < health->n_inputs; i++) {
        double scales = health_scales(health, i, health->input[i].farthest);
        if (health->input[i].far > 0 && scales > most) {
            most = scales;
            worst = i;
        }
    }
    return worst;
}

bool health_lacks_samples(const struct health *health, const struct learner_statistics *statistics)
{
    return statistics->samples < (uint64_t)health->least_samples * (uint64_t)statistics->experts;
}

double health_mean_solutions(const struct health *health)
{
    return health->predictions < LEAST_PREDICTIONS
               ? NAN
               : (double)health->solutions / (double)health->predictions;
}

/* A branch is one expert. There are too many where each had few samples, or where most of them say
 * what another says. */
static bool experts_abound(const struct health *health, const struct learner_statistics *statistics)
{
    if (health->least_samples == 0 || statistics->experts < LEAST_EXPERTS)
        return false;
    return health_lacks_samples(health, statistics) ||
           statistics->experts > 1 + 2 * health_mean_solutions(health);
}

unsigned health_judge(const struct health *health, const struct learner_statistics *statistics)
{
    return (unsigned)too_many(health, health->full) << HEALTH_FULL |
           (unsigned)too_many(health, health->outliers) << HEALTH_OUTLIERS |
           (unsigned)is_far(health) << HEALTH_FAR |
           (unsigned)is_constant(health) << HEALTH_CONSTANT |
           (unsigned)(health->frozen > 0) << HEALTH_FROZEN |
           (unsigned)experts_abound(health, statistics) << HEALTH_EXPERTS;
}
