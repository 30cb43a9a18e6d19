/* Feature maps: how many, what they are, and their derivative against finite differences. */
#include <math.h>

#include "bed.h"
#include "learner/features/feature_map.h"
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

static struct feature_map *create_map(const struct learner_config *config, struct arena **arena)
{
    *arena = arena_create(feature_map_memory(config));
    ck_assert_ptr_nonnull(*arena);
    struct feature_map *map = feature_map_create(config, *arena);
    ck_assert_ptr_nonnull(map);
    ck_assert_uint_eq(arena_used(*arena), feature_map_memory(config));
    return map;
}

START_TEST(counts_are_binomials)
{
    const int cases[][3] = {{1, 1, 2}, {4, 3, 35}, {7, 2, 36}, {7, 4, 330}, {16, 2, 153}};

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct learner_config config = polynomial(cases[i][0], cases[i][1]);
        ck_assert_int_eq(feature_map_count(&config), cases[i][2]);
    }
    struct learner_config too_many = polynomial(16, 4);
    ck_assert_int_eq(feature_map_count(&too_many), 0);
}
END_TEST

/* sum phi(u) phi(v) = exp(-|u|^2 / 2 - |v|^2 / 2) times e^(u v), whose series is cut off. */
START_TEST(features_are_terms_of_the_gaussian_kernel)
{
    struct learner_config config = polynomial(2, 6);
    struct arena *arena = NULL;
    struct feature_map *map = create_map(&config, &arena);
    const double u[2] = {0.3, -0.8};
    const double v[2] = {0.5, 0.4};
    double product = u[0] * v[0] + u[1] * v[1];
    double sum = 0.0;
    double series = 1.0;
    double term = 1.0;

    feature_map_evaluate(map, u, phi);
    feature_map_evaluate(map, v, up);
    for (int k = 0; k < feature_map_count(&config); k++)
        sum += phi[k] * up[k];
    for (int n = 1; n <= 6; n++) {
        term *= product / n;
        series += term;
    }
    double envelope = exp(-0.5 * (u[0] * u[0] + u[1] * u[1] + v[0] * v[0] + v[1] * v[1]));
    ck_assert_double_eq_tol(sum, envelope * series, 1e-14);
    ck_assert_double_eq_tol(sum, exp(-0.5 * (0.2 * 0.2 + 1.2 * 1.2)), 1e-6);
    arena_destroy(arena);
}
END_TEST

static void compare_with_differences(const struct learner_config *config)
{
    struct arena *arena = NULL;
    struct feature_map *map = create_map(config, &arena);
    int d = config->n_inputs;
    double z[LEARNER_MAX_INPUTS];
    double shifted[LEARNER_MAX_INPUTS];

    for (int i = 0; i < d; i++)
        z[i] = shifted[i] = bed_uniform(-1.0, 1.0);
    feature_map_evaluate(map, z, phi);
    feature_map_derivative(map, z, phi, dphi);
    for (int i = 0; i < d; i++) {
        shifted[i] = z[i] + 1e-5;
        feature_map_evaluate(map, shifted, up);
        shifted[i] = z[i] - 1e-5;
        feature_map_evaluate(map, shifted, down);
        shifted[i] = z[i];
        for (int k = 0; k < feature_map_count(config); k++)
            ck_assert_double_eq_tol(dphi[i * feature_map_count(config) + k],
                                    (up[k] - down[k]) / 2e-5, 1e-8);
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
        features_are_terms_of_the_gaussian_kernel,
        derivatives_match_differences,
    };

    return SUITE_RUN("learner features", tests);
}
