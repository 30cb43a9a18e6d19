/* Feature maps: how many, what they are, and their derivative against finite differences. */
#include <math.h>

#include "daemon/feature_map.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

static double phi[FEATURE_MAP_MAX], up[FEATURE_MAP_MAX], down[FEATURE_MAP_MAX];
static double dphi[FEATURE_MAP_MAX * LEARNER_MAX_INPUTS];

static struct learner_config polynomial(int n_inputs, int degree)
{
    struct learner_config config = learner_config_default(n_inputs, 1);

    config.features = LEARNER_POLYNOMIAL;
    config.degree = degree;
    return config;
}

static struct feature_map *create(const struct learner_config *config, struct arena **arena)
{
    *arena = arena_create(feature_map_memory(config));
    ck_assert_ptr_nonnull(*arena);
    struct feature_map *map = feature_map_create(config, *arena);
    ck_assert_ptr_nonnull(map);
    ck_assert_uint_eq(arena_used(*arena), arena_size(*arena));
    return map;
}

START_TEST(counts_are_binomials)
{
    const int cases[][3] = {{1, 1, 1}, {4, 3, 34}, {7, 2, 35}, {7, 4, 329}, {16, 2, 152}};

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct learner_config config = polynomial(cases[i][0], cases[i][1]);
        ck_assert_int_eq(feature_map_count(&config), cases[i][2]);
    }
    struct learner_config too_many = polynomial(16, 4);
    ck_assert_int_eq(feature_map_count(&too_many), 0);
}
END_TEST

/* All monomials of e^(u + v) up to the degree add up to its Taylor polynomial. */
START_TEST(features_are_taylor_terms)
{
    struct learner_config config = polynomial(2, 6);
    struct arena *arena = NULL;
    struct feature_map *map = create(&config, &arena);
    const double z[2] = {0.3, -0.8};
    double sum = 0.0;
    double taylor = 0.0;
    double term = 1.0;

    feature_map_evaluate(map, z, phi);
    for (int k = 0; k < feature_map_count(&config); k++)
        sum += phi[k];
    for (int n = 1; n <= 6; n++) {
        term *= (z[0] + z[1]) / n;
        taylor += term;
    }
    ck_assert_double_eq_tol(sum, taylor, 1e-14);
    arena_destroy(arena);
}
END_TEST

static void compare_with_differences(const struct learner_config *config)
{
    struct arena *arena = NULL;
    struct feature_map *map = create(config, &arena);
    int d = config->n_inputs;
    double z[LEARNER_MAX_INPUTS];
    double shifted[LEARNER_MAX_INPUTS];

    for (int i = 0; i < d; i++)
        z[i] = shifted[i] = bed_uniform(-1.0, 1.0);
    feature_map_evaluate(map, z, phi);
    feature_map_derivative(map, phi, dphi);
    for (int i = 0; i < d; i++) {
        shifted[i] = z[i] + 1e-5;
        feature_map_evaluate(map, shifted, up);
        shifted[i] = z[i] - 1e-5;
        feature_map_evaluate(map, shifted, down);
        shifted[i] = z[i];
        for (int k = 0; k < feature_map_count(config); k++)
            ck_assert_double_eq_tol(dphi[k * d + i], (up[k] - down[k]) / 2e-5, 1e-8);
    }
    arena_destroy(arena);
}

START_TEST(derivatives_match_differences)
{
    bed_seed();
    for (int d = 1; d <= 5; d++) {
        for (int degree = 1; degree <= 4; degree++) {
            struct learner_config config = polynomial(d, degree);
            config.reference[d - 1] = 0.4;
            config.scale[0] = 1.7;
            compare_with_differences(&config);
        }
        struct learner_config linear = learner_config_default(d, 1);
        linear.scale[0] = 0.6;
        compare_with_differences(&linear);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        counts_are_binomials,
        features_are_taylor_terms,
        derivatives_match_differences,
    };

    return SUITE_RUN("learner features", tests);
}
