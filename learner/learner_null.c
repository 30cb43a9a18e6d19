/* The learner that learns nothing: it lets everything around a learner be tested without one. */
#include "learner/kind.h"

static int null_check(const struct learner_config *config, char *err, size_t err_size)
{
    (void)config;
    (void)err;
    (void)err_size;
    return 0;
}

static uint64_t null_hash(const struct learner_config *config, uint64_t hash)
{
    (void)config;
    return hash;
}

static size_t null_memory(const struct learner_config *config)
{
    (void)config;
    return arena_footprint(1);
}

static void *null_create(const struct learner_config *config, struct arena *arena)
{
    (void)config;
    return arena_alloc(arena, 1);
}

static enum learner_update_result null_update(void *self, const double *z, const double *x)
{
    (void)self;
    (void)z;
    (void)x;
    return LEARNER_UPDATED;
}

static int null_predict(void *self, const double *z, struct learner_prediction *prediction)
{
    (void)self;
    (void)z;
    (void)prediction;
    return 0;
}

static int null_predict_single(void *self, const double *z, struct learner_solution *solution)
{
    (void)self;
    (void)z;
    (void)solution;
    return 0;
}

static int null_predict_inverse(void *self, const double *x, struct learner_inverse *inverse)
{
    (void)self;
    (void)x;
    (void)inverse;
    return 0;
}

static int null_experts(const void *self)
{
    (void)self;
    return 0;
}

static size_t null_state_size(const void *self, int n_experts)
{
    (void)self;
    (void)n_experts;
    return 0;
}

static void null_save(const void *self, unsigned char *buffer)
{
    (void)self;
    (void)buffer;
}

static int null_load(void *self, int n_experts, const unsigned char *buffer, char *err,
                     size_t err_size)
{
    (void)self;
    (void)n_experts;
    (void)buffer;
    (void)err;
    (void)err_size;
    return 0;
}

const struct learner_ops learner_null_ops = {
    .name = "null",
    .check = null_check,
    .hash = null_hash,
    .memory = null_memory,
    .create = null_create,
    .update = null_update,
    .predict = null_predict,
    .predict_single = null_predict_single,
    .predict_inverse = null_predict_inverse,
    .experts = null_experts,
    .state_size = null_state_size,
    .save = null_save,
    .load = null_load,
};
