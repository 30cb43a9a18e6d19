/* What breaks learners: still data, offsets, forgetting, extreme scales, input that is no number.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "learner/imle/triangle.h"
#include "learner/imle/whitener.h"
#include "tests/unit/suite.h"

static struct learner_prediction prediction;
static struct learner_inverse inverse;

static struct learner_config config_for(enum learner_features features, double alpha)
{
    struct learner_config config = learner_config_default(2, 2);

    config.features = features;
    config.alpha = alpha;
    config.capacity = 32;
    config.psi0[0] = config.psi0[1] = 0.01;
    config.sigma0[0] = config.sigma0[1] = 0.1;
    config.clustering =
        features == LEARNER_LINEAR ? LEARNER_CLUSTER_PUBLISHED : LEARNER_CLUSTER_LEADER;
    config.gamma_floor = features == LEARNER_LINEAR ? 0.0 : 0.05;
    return config;
}

static void expect_finite(struct learner *learner, const double *z)
{
    ck_assert_int_ge(learner_predict(learner, z, &prediction), 1);
    for (int k = 0; k < prediction.n_solutions; k++) {
        const struct learner_solution *s = &prediction.solution[k];
        ck_assert(isfinite(s->weight) && isfinite(s->value[0]) && isfinite(s->value[1]));
        ck_assert(s->variance[0] > 0.0);
        for (int i = 0; i < 4; i++)
            ck_assert(isfinite(s->jacobian[i]));
    }
}

/* A robot that holds still within `jitter` of an offset, and then moves and must still learn. */
static void hold_still(const struct learner_config *config, double offset, double jitter, int n)
{
    struct learner *learner = bed_create(config);
    double z[2], x[2];

    for (int k = 0; k < n + 3000; k++) {
        double range = k < n ? jitter : 0.3;
        z[0] = offset + range * bed_uniform(-1.0, 1.0);
        z[1] = offset + range * bed_uniform(-1.0, 1.0);
        x[0] = 2.0 * (z[0] - offset) + 1.0;
        x[1] = z[1] - z[0];
        ck_assert_int_ne(learner_update(learner, z, x), LEARNER_REFUSED);
        if (k > 2 && k % 997 == 0)
            expect_finite(learner, z);
    }
    expect_finite(learner, z);
    ck_assert_double_eq_tol(prediction.solution[0].value[0], x[0], 0.3);
    bed_clean();
}

START_TEST(a_still_robot_breaks_nothing)
{
    const double alphas[] = {0.9, 0.99, 1.0};
    const double offsets[] = {0.0, 100.0, 1000.0};
    const double jitters[] = {0.0, 0.001, 0.1};

    bed_seed();
    for (int features = LEARNER_LINEAR; features <= LEARNER_POLYNOMIAL; features++)
        for (int a = 0; a < 3; a++)
            for (int k = 0; k < 3; k++) {
                struct learner_config config =
                    config_for((enum learner_features)features, alphas[a]);
                config.reference[0] = config.reference[1] =
                    features == LEARNER_LINEAR ? 0.0 : offsets[k];
                hold_still(&config, offsets[k], jitters[(a + k) % 3], 20000);
            }
}
END_TEST

static struct learner_config lwpr_config(double lambda)
{
    struct learner_config config = config_for(LEARNER_LINEAR, 0.999);

    config.kind = LEARNER_LWPR;
    config.lwpr.init_lambda = config.lwpr.final_lambda = lambda;
    return config;
}

/* The first case is long enough for what is not refreshed to be forgotten down to zero. */
START_TEST(a_still_robot_breaks_no_receptive_field)
{
    const double lambdas[] = {0.9, 0.99, 0.999, 1.0};
    const double offsets[] = {0.0, 100.0, 1000.0};
    const double jitters[] = {0.0, 0.001, 0.1};

    bed_seed();
    for (int a = 0; a < 4; a++)
        for (int k = 0; k < 3; k++) {
            struct learner_config config = lwpr_config(lambdas[a]);
            config.lwpr.diagonal_only = k != 1;
            hold_still(&config, offsets[k], jitters[(a + k) % 3], a + k == 0 ? 100000 : 10000);
        }
}
END_TEST

/* Inputs and outputs over 18 decades, all on one line. */
static void expect_finite_on_a_line(const struct learner_config *config)
{
    struct learner *learner = bed_create(config);

    for (int n = 0; n < 3000; n++) {
        double size = pow(10.0, bed_uniform(-9.0, 9.0));
        double z[2] = {size, size};
        double x[2] = {-size, bed_uniform(-1.0, 1.0) * size};
        ck_assert_int_ne(learner_update(learner, z, x), LEARNER_REFUSED);
        if (n > 2)
            expect_finite(learner, z);
    }
    bed_clean();
}

START_TEST(receptive_fields_stay_finite_on_collinear_and_huge_inputs)
{
    bed_seed();
    for (int full = 0; full < 2; full++)
        for (int wide = 0; wide < 2; wide++) {
            struct learner_config config = lwpr_config(0.999);
            config.lwpr.diagonal_only = !full;
            if (wide)
                config.scale[0] = config.scale[1] = 1e6;
            expect_finite_on_a_line(&config);
        }
}
END_TEST

START_TEST(collinear_and_huge_inputs_stay_finite)
{
    bed_seed();
    for (int features = LEARNER_LINEAR; features <= LEARNER_POLYNOMIAL; features++) {
        struct learner_config config = config_for((enum learner_features)features, 0.95);
        expect_finite_on_a_line(&config);
    }
}
END_TEST

START_TEST(what_is_no_number_is_refused)
{
    struct learner_config config = config_for(LEARNER_LINEAR, 0.999);
    struct learner *learner = bed_create(&config);
    const double good[2] = {0.1, 0.2};
    const double bad[][2] = {{NAN, 0.0}, {0.0, INFINITY}, {-INFINITY, 0.0}, {1e10, 0.0}};

    for (int n = 0; n < 4; n++) {
        ck_assert_int_eq(learner_update(learner, bad[n], good), LEARNER_REFUSED);
        ck_assert_int_eq(learner_update(learner, good, bad[n]), LEARNER_REFUSED);
    }
    ck_assert_uint_eq(learner_get_statistics(learner).refused, 8);
    ck_assert_int_eq(learner_predict(learner, good, &prediction), 0);
    learner_update(learner, good, good);
    learner_update(learner, good, good);
    ck_assert_int_eq(learner_predict(learner, good, &prediction), 1);
    ck_assert_int_eq(learner_predict(learner, bad[0], &prediction), 0);
    ck_assert_int_eq(learner_predict_inverse(learner, bad[1], &inverse), 0);
    bed_clean();
}
END_TEST

/* A whitener that a million samples have gone through is that of the matrix they add up to. */
START_TEST(whiteners_do_not_drift)
{
    enum { N = 9 };
    const struct kernels *kernels = kernels_of(LEARNER_KERNELS_AUTO);
    const double factor = 0.999;
    double G[N * (N + 1) / 2], C[N * (N + 1) / 2], v[N], white[N], back[N], scratch[4][N];
    const struct whitener_scratch add = {scratch[0], scratch[1], scratch[2], scratch[3]};

    bed_seed();
    whitener_set_diagonal(N, G, 1.0);
    triangle_set_diagonal(N, C, 1.0);
    for (int n = 0; n < 1000000; n++) {
        for (int i = 0; i < N; i++)
            v[i] = bed_uniform(-1.0, 1.0) * (i + 1);
        kernels->whiten(N, G, v, white, back);
        whitener_add(kernels, N, 0, G, factor, 1.0, white, &add);
        for (int i = 0; i < N; i++)
            for (int k = i; k < N; k++) {
                double *entry = C + triangle_column(N, i) + (size_t)(k - i);
                *entry = factor * *entry + v[i] * v[k];
            }
    }
    ck_assert_int_eq(triangle_factor(N, C), 0);
    triangle_invert(N, C);
    for (int i = 0; i < N; i++)
        for (int k = i; k < N; k++) {
            double exact = C[triangle_column(N, i) + (size_t)(k - i)];
            ck_assert_double_eq_tol(G[whitener_row(k) + (size_t)i], exact,
                                    1e-10 * (1.0 + fabs(exact)));
        }
}
END_TEST

/* A robot that holds still for a million samples, or REACH_TEST_SAMPLES: exactly, or within a
 * jitter, also at an offset, with forgetting. What it learned where it stands must be right
 * afterwards. */
START_TEST(a_million_still_samples_break_nothing)
{
    const char *text = getenv("REACH_TEST_SAMPLES");
    long samples = text ? strtol(text, NULL, 10) : 1000000;

    bed_seed();
    for (int run = 0; run < 4; run++) {
        struct learner_config config = config_for(LEARNER_LINEAR, run % 2 ? 0.9 : 0.999);
        struct learner *learner = bed_create(&config);
        double offset = run / 2 ? 1000.0 : 0.0;
        double jitter = run / 2 ? 1e-6 : 0.0;
        double z[2], x[2];
        for (long n = 0; n < samples / 4; n++) {
            z[0] = offset + jitter * bed_uniform(-1.0, 1.0);
            z[1] = offset + jitter * bed_uniform(-1.0, 1.0);
            x[0] = 3.0 + (z[0] - offset);
            x[1] = -2.0;
            ck_assert_int_ne(learner_update(learner, z, x), LEARNER_REFUSED);
        }
        expect_finite(learner, z);
        ck_assert_int_eq(prediction.n_solutions, 1);
        ck_assert_double_eq_tol(prediction.solution[0].value[0], x[0], 1e-5);
        ck_assert_double_eq_tol(prediction.solution[0].value[1], x[1], 1e-5);
        bed_clean();
    }
}
END_TEST

/* Inputs and outputs in units from 1e-2 to 1e4: the same answers, in those units. Below that the
 * scatter of 1e-6 that an expert is published to be born with outweighs the samples: only finite.
 */
START_TEST(units_do_not_matter)
{
    const double units[] = {1e-5, 1e-2, 1.0, 1e2, 1e4};

    bed_seed();
    for (int u = 0; u < 5; u++) {
        struct learner_config config = config_for(LEARNER_LINEAR, 0.999);
        double unit = units[u];
        double error = 0.0;
        config.ridge *= unit * unit;
        for (int i = 0; i < 2; i++) {
            config.psi0[i] *= unit * unit;
            config.sigma0[i] *= unit * unit;
        }
        struct learner *learner = bed_create(&config);
        for (int n = 0; n < 4000; n++) {
            double z[2] = {unit * bed_uniform(-1.0, 1.0), unit * bed_uniform(-1.0, 1.0)};
            double x[2] = {z[0] - 2.0 * z[1], z[1] + z[0]};
            learner_update(learner, z, x);
            if (n < 3500)
                continue;
            expect_finite(learner, z);
            double off = (prediction.solution[0].value[0] - x[0]) / unit;
            error += off * off / 500.0;
        }
        ck_assert_msg(unit < 1e-2 || sqrt(error) < 0.1, "unit %g: RMSE %g", unit, sqrt(error));
        bed_clean();
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_still_robot_breaks_nothing,
        a_still_robot_breaks_no_receptive_field,
        receptive_fields_stay_finite_on_collinear_and_huge_inputs,
        collinear_and_huge_inputs_stay_finite,
        what_is_no_number_is_refused,
        whiteners_do_not_drift,
        a_million_still_samples_break_nothing,
        units_do_not_matter,
    };

    return SUITE_RUN("learner numerics", tests);
}
