#include "learner/features/feature_map_private.h"

static const struct feature_map_ops *ops_of(const struct learner_config *config)
{
    return config->features != LEARNER_LINEAR ? &feature_map_polynomial : &feature_map_linear;
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
