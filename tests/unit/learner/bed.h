/* What the learner's tests share: a seeded source of numbers, and a learner in its own arena. */
#ifndef REACH_TEST_LEARNER_BED_H
#define REACH_TEST_LEARNER_BED_H

#include <stdint.h>

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Starts the numbers from REACH_TEST_SEED, or from 1, and prints which. */
void bed_seed(void);

/* Uniform in [low, high); normal with mean 0 and deviation 1. */
double bed_uniform(double low, double high);
double bed_normal(void);

/* A learner with room for all that its configuration allows. The test fails when it is refused. */
struct learner *bed_create(const struct learner_config *config);

/* The learner's state in *size bytes that the caller frees. */
unsigned char *bed_saved(const struct learner *learner, size_t *size);

/* The test fails unless both states are the same bytes. */
void bed_expect_same_state(const struct learner *one, const struct learner *other);

/* The squared distance from x[n_outputs] of the nearest solution at z; INFINITY without any. */
double bed_square_off(struct learner *learner, const double *z, const double *x, int n_outputs);

/* Frees what bed_create() made since the last time. */
void bed_clean(void);

#ifdef __cplusplus
}
#endif
#endif
