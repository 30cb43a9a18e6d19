/* What an expert is linear in: a vector of features phi of the input, behind a small table of
 * functions. A constant is left out: experts are centred, so it needs no coefficient.
 *
 * u = (z - reference) / scale, one number an input.
 *   linear:      phi = u
 *   polynomial:  phi_a = exp(-|u|^2 / 2) prod_i u_i^a_i / sqrt(a_i!)  for |a| <= degree
 * The latter are the leading terms of the Gaussian kernel: over all a, sum phi_a(u) phi_a(v) =
 * exp(-|u - v|^2 / 2). A regression with one ridge on them is that of a Gaussian process, cut off
 * at the degree: equally unsure everywhere, and bounded far away. */
#ifndef REACH_LEARNER_FEATURES_FEATURE_MAP_H
#define REACH_LEARNER_FEATURES_FEATURE_MAP_H

#include "common/base/arena.h"
#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Most features of a map: more would not fit a control tick. */
#define FEATURE_MAP_MAX 1024

struct feature_map;

/* Features of the map that `config` describes; 0 when they would be over FEATURE_MAP_MAX. */
int feature_map_count(const struct learner_config *config);

/* Bytes that feature_map_create() takes from the arena. */
size_t feature_map_memory(const struct learner_config *config);

/* A map that lives in the arena, or NULL when the arena is exhausted. feature_map_count() of the
 * configuration must not be 0. */
struct feature_map *feature_map_create(const struct learner_config *config, struct arena *arena);

/* phi[count] at z[n_inputs]. */
void feature_map_evaluate(const struct feature_map *map, const double *z, double *phi);

/* d phi / d z at z, whose features are phi: dphi[n_inputs * count], a row an input. */
void feature_map_derivative(const struct feature_map *map, const double *z, const double *phi,
                            double *dphi);

#ifdef __cplusplus
}
#endif
#endif
