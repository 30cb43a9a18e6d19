#include "learner/features/feature_map_private.h"

#include <string.h>

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

static const struct feature_map_ops *ops_of(const struct learner_config *config)
{
    return config->features == LEARNER_POLYNOMIAL ? &feature_map_polynomial : &feature_map_linear;
}

int feature_map_count(const struct learner_config *config)
{
    return ops_of(config)->count(config->n_inputs, config->degree);
}

size_t feature_map_memory(const struct learner_config *config)
{
    return arena_footprint(sizeof(struct feature_map)) +
           ops_of(config)->memory(config->n_inputs, config->degree);
}

struct feature_map *feature_map_create(const struct learner_config *config, struct arena *arena)
{
    struct feature_map *map = arena_alloc(arena, sizeof *map);

    if (!map)
        return NULL;
    map->ops = ops_of(config);
    map->n_inputs = config->n_inputs;
    map->n_features = feature_map_count(config);
    map->degree = config->degree;
    for (int i = 0; i < config->n_inputs; i++) {
        map->reference[i] = config->reference[i];
        map->per_scale[i] = 1.0 / config->scale[i];
    }
    return map->ops->prepare(map, arena) == 0 ? map : NULL;
}

static void scale_input(const struct feature_map *map, const double *z, double *u)
{
    for (int i = 0; i < map->n_inputs; i++)
        u[i] = (z[i] - map->reference[i]) * map->per_scale[i];
}

void feature_map_evaluate(const struct feature_map *map, const double *z, double *phi)
{
    double u[LEARNER_MAX_INPUTS];

    scale_input(map, z, u);
    map->ops->evaluate(map, u, phi);
}

void feature_map_derivative(const struct feature_map *map, const double *z, const double *phi,
                            double *dphi)
{
    double u[LEARNER_MAX_INPUTS];

    scale_input(map, z, u);
    map->ops->derivative(map, u, phi, dphi);
    for (int i = 0; i < map->n_inputs; i++)
        for (int k = 0; k < map->n_features; k++)
            dphi[i * map->n_features + k] *= map->per_scale[i];
}
