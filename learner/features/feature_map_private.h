/* What implementations of a feature map share; see feature_map.h. */
#ifndef REACH_LEARNER_FEATURES_FEATURE_MAP_PRIVATE_H
#define REACH_LEARNER_FEATURES_FEATURE_MAP_PRIVATE_H

#include <stdint.h>

#include "learner/features/feature_map.h"

/* A monomial is its parent times one more input; the constant is number 0 and has none. */
struct monomial {
    int16_t parent;
    int16_t variable; /* the input that the parent is multiplied by */
    double factor;    /* 1 / root of that input's power in the product */
};

/* A monomial with one power of an input less. */
struct lowered_monomial {
    int index;   /* -1 when there was none to take */
    double root; /* of the power before */
};

struct feature_map {
    const struct feature_map_ops *ops;
    int n_inputs;
    int n_features;
    int degree;
    double reference[LEARNER_MAX_INPUTS];
    double per_scale[LEARNER_MAX_INPUTS]; /* 1 / scale */
    struct monomial *monomials;           /* polynomial: n_features, parents first */
    struct lowered_monomial *lowered;     /* polynomial: n_features x n_inputs */
};

struct feature_map_ops {
    int (*count)(int n_inputs, int degree);
    size_t (*memory)(int n_inputs, int degree);
    /* Fills in what is its own of an otherwise complete map. 0, or -1 when out of memory. */
    int (*prepare)(struct feature_map *map, struct arena *arena);
    void (*evaluate)(const struct feature_map *map, const double *u, double *phi);
    /* d phi / d u; the caller applies the scale. */
    void (*derivative)(const struct feature_map *map, const double *u, const double *phi,
                       double *dphi);
};

extern const struct feature_map_ops feature_map_linear;
extern const struct feature_map_ops feature_map_polynomial;

#endif
