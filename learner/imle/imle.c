/* The infinite mixture of experts behind the learner's interface: checks, creation and the
 * table. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/base/hash.h"
#include "learner/base/ranges.h"
#include "learner/imle/chi2.h"
#include "learner/imle/imle.h"

static void set_dimensions(struct imle *m, const struct learner_config *config)
{
    m->config = *config;
    m->d = config->n_inputs;
    m->D = config->n_outputs;
    m->p = feature_map_count(config);
    m->small = m->p <= LEARNER_MAX_INPUTS;
}

static bool births_by_evidence(const struct learner_config *config)
{
    return config->births == LEARNER_BIRTHS_EVIDENCE ||
           (config->births == LEARNER_BIRTHS_AUTO && config->features != LEARNER_LINEAR);
}

static int check_variances(const struct learner_config *config, char *err, size_t err_size)
{
    for (int i = 0; i < config->n_inputs; i++) {
        const struct learner_range range = {"sigma0", config->sigma0[i], 1e-12, 1e12};
        if (learner_check_ranges(&range, 1, err, err_size) != 0)
            return -1;
    }
    for (int i = 0; i < config->n_outputs; i++) {
        const struct learner_range range = {"psi0", config->psi0[i], 1e-12, 1e12};
        if (learner_check_ranges(&range, 1, err, err_size) != 0)
            return -1;
    }
    return 0;
}

static int check_parameters(const struct learner_config *config, char *err, size_t err_size)
{
    if (check_variances(config, err, err_size) != 0)
        return -1;
    if (!kernels_of(config->kernels)) {
        snprintf(err, err_size, "kernels is %d: this machine has no such vectors",
                 (int)config->kernels);
        return -1;
    }
    if (feature_map_count(config) > 0)
        return 0;
    snprintf(err, err_size, "degree %d of %d inputs gives more than %d features: lower the degree",
             config->degree, config->n_inputs, FEATURE_MAP_MAX);
    return -1;
}

static uint64_t hash_variances(const struct learner_config *config, uint64_t hash)
{
    double by_evidence = 1.0;

    if (births_by_evidence(config))
        hash = learner_hash(hash, &by_evidence, sizeof by_evidence);
    hash = learner_hash(hash, config->sigma0, (size_t)config->n_inputs * sizeof(double));
    return learner_hash(hash, config->psi0, (size_t)config->n_outputs * sizeof(double));
}

static size_t memory(const struct learner_config *config)
{
    struct imle m;

    memset(&m, 0, sizeof m);
    set_dimensions(&m, config);
    return arena_footprint(sizeof m) + feature_map_memory(config) + imle_layout(&m, NULL);
}

static void *create(const struct learner_config *config, struct arena *arena)
{
    struct imle *m = arena_alloc(arena, sizeof *m);

    if (!m)
        return NULL;
    set_dimensions(m, config);
    m->kernels = kernels_of(config->kernels);
    m->query.whitened = -1;
    m->map = feature_map_create(config, arena);
    if (!m->map || imle_layout(m, arena) == 0)
        return NULL;
    imle_forget(m);
    m->log_c_joint = -0.5 * chi2_quantile(m->d + m->D, 1.0 - config->p0);
    m->log_c_input = -0.5 * chi2_quantile(m->d, 1.0 - config->p0);
    m->by_evidence = births_by_evidence(config);
    m->leader_threshold = chi2_quantile(m->D, config->leader_level);
    return m;
}

static enum learner_update_result update(void *self, const double *z, const double *x)
{
    return imle_learn(self, z, x);
}

static int predict(void *self, const double *z, struct learner_prediction *prediction)
{
    return imle_predict(self, z, prediction);
}

static int predict_single(void *self, const double *z, struct learner_solution *solution)
{
    return imle_predict_single(self, z, solution);
}

static int predict_inverse(void *self, const double *x, struct learner_inverse *inverse)
{
    return imle_predict_inverse(self, x, inverse);
}

int imle_experts(const void *self)
{
    const struct imle *m = self;
    int n = 0;

    for (int j = 0; j < m->state.M; j++)
        n += !imle_vacant(m, j);
    return n;
}

const struct learner_ops learner_imle_ops = {
    .number = 0,
    .check = check_parameters,
    .hash = hash_variances,
    .memory = memory,
    .create = create,
    .update = update,
    .predict = predict,
    .predict_single = predict_single,
    .predict_inverse = predict_inverse,
    .experts = imle_experts,
    .saved_experts = imle_saved_experts,
    .state_size = imle_state_size,
    .save = imle_save,
    .load = imle_load,
};
