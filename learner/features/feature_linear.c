/* The inputs themselves: what the published algorithm is linear in. */
#include <string.h>

#include "learner/features/feature_map_private.h"

static int linear_count(int n_inputs, int degree)
{
    (void)degree;
    return n_inputs;
}

static size_t linear_memory(int n_inputs, int degree)
{
    (void)n_inputs;
    (void)degree;
    return 0;
}

static int linear_prepare(struct feature_map *map, struct arena *arena)
{
    (void)map;
    (void)arena;
    return 0;
}

static void linear_evaluate(const struct feature_map *map, const double *u, double *phi)
{
    memcpy(phi, u, (size_t)map->n_inputs * sizeof *phi);
}

static void linear_derivative(const struct feature_map *map, const double *u, const double *phi,
                              double *dphi)
{
    int d = map->n_inputs;

    (void)u;
    (void)phi;
    memset(dphi, 0, (size_t)(d * d) * sizeof *dphi);
    for (int i = 0; i < d; i++)
        dphi[i * d + i] = 1.0;
}

const struct feature_map_ops feature_map_linear = {
    .count = linear_count,
    .memory = linear_memory,
    .prepare = linear_prepare,
    .evaluate = linear_evaluate,
    .derivative = linear_derivative,
};
