/* Locally weighted projection regression behind the learner's interface: ranges, creation and the
 * table. */
#include <string.h>

#include "common/base/elementary.h"
#include "learner/base/hash.h"
#include "learner/base/ranges.h"
#include "learner/lwpr/lwpr.h"

struct learner_lwpr_config learner_lwpr_default(int n_inputs)
{
    struct learner_lwpr_config p = {
        .init_d = 10.0,
        .init_alpha = 50.0,
        .penalty = 1e-6,
        .w_gen = 0.1,
        .w_prune = 0.9,
        .cutoff = 0.001,
        .init_lambda = 0.999,
        .final_lambda = 0.99999,
        .tau_lambda = 0.9999,
        .init_s2 = 1e-10,
        .add_threshold = 0.5,
        .max_projections = n_inputs,
        .diagonal_only = true,
    };

    for (int i = 0; i < LEARNER_MAX_OUTPUTS; i++)
        p.norm_out[i] = 1.0;
    return p;
}

/* What rows of each other ask; each alone has been checked. */
static int check_parameters(const struct learner_config *config, char *err, size_t err_size)
{
    const struct learner_lwpr_config *p = &config->lwpr;
    /* A projection counts after 2 d samples: what is forgotten sooner would never count. */
    double least_lambda = 1.0 - 1.0 / (3.0 * config->n_inputs);
    const struct learner_range ranges[] = {
        {"lwpr.init_lambda", p->init_lambda, least_lambda, 1.0},
        {"lwpr.final_lambda", p->final_lambda, least_lambda, 1.0},
        {"lwpr.w_prune", p->w_prune, p->w_gen, 1.0},
        {"lwpr.cutoff", p->cutoff, 0.0, p->w_gen},
        {"lwpr.max_projections", p->max_projections, 1, config->n_inputs},
    };

    for (int i = 0; i < config->n_outputs; i++) {
        const struct learner_range norm = {"lwpr.norm_out", p->norm_out[i], 1e-9,
                                           LEARNER_LARGEST_NUMBER};
        if (learner_check_ranges(&norm, 1, err, err_size) != 0)
            return -1;
    }
    return LEARNER_CHECK_RANGES(ranges, err, err_size);
}

static uint64_t hash_parameters(const struct learner_config *config, uint64_t hash)
{
    const struct learner_lwpr_config *p = &config->lwpr;
    const double numbers[] = {
        p->init_d,  p->diagonal_only, p->init_alpha,      p->penalty,      p->w_gen,
        p->w_prune, p->cutoff,        p->init_lambda,     p->final_lambda, p->tau_lambda,
        p->init_s2, p->add_threshold, p->max_projections,
    };

    hash = learner_hash(hash, numbers, sizeof numbers);
    return learner_hash(hash, p->norm_out, (size_t)config->n_outputs * sizeof(double));
}

static void set_dimensions(struct lwpr *m, const struct learner_config *config)
{
    m->config = *config;
    m->p = config->lwpr;
    m->d = config->n_inputs;
    m->D = config->n_outputs;
    m->R = m->p.max_projections;
    m->n_root = m->p.diagonal_only ? m->d : m->d * (m->d + 1) / 2;
    m->q_gen = -2.0 * elementary_log(m->p.w_gen);
    m->q_prune = -2.0 * elementary_log(m->p.w_prune);
    m->q_cutoff = -2.0 * elementary_log(m->p.cutoff);
}

static size_t memory(const struct learner_config *config)
{
    struct lwpr m;

    memset(&m, 0, sizeof m);
    set_dimensions(&m, config);
    return arena_footprint(sizeof m) + lwpr_layout(&m, NULL);
}

static void *create(const struct learner_config *config, struct arena *arena)
{
    struct lwpr *m = arena_alloc(arena, sizeof *m);

    if (!m)
        return NULL;
    set_dimensions(m, config);
    return lwpr_layout(m, arena) > 0 ? m : NULL;
}

static enum learner_update_result update(void *self, const double *z, const double *x)
{
    return lwpr_learn(self, z, x);
}

static int predict(void *self, const double *z, struct learner_prediction *prediction)
{
    return lwpr_predict(self, z, &prediction->solution[0]);
}

static int predict_single(void *self, const double *z, struct learner_solution *solution)
{
    return lwpr_predict(self, z, solution);
}

/* None: fields are regressions of one output each in regions of their own, so no field has a point
 * that gives all outputs, and a search would predict at every centre. */
static int predict_inverse(void *self, const double *x, struct learner_inverse *inverse)
{
    (void)self;
    (void)x;
    (void)inverse;
    return 0;
}

static int experts(const void *self)
{
    const struct lwpr *m = self;

    return m->M;
}

const struct learner_ops learner_lwpr_ops = {
    .number = 2,
    .check = check_parameters,
    .hash = hash_parameters,
    .memory = memory,
    .create = create,
    .update = update,
    .predict = predict,
    .predict_single = predict_single,
    .predict_inverse = predict_inverse,
    .experts = experts,
    .state_size = lwpr_state_size,
    .save = lwpr_save,
    .load = lwpr_load,
};
