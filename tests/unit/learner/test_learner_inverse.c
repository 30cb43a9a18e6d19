/* Inputs that give a wanted output, checked by predicting forward again. */
#include <math.h>

#include "bed.h"
#include "tests/unit/suite.h"

static struct learner_prediction forward;
static struct learner_inverse inverse;

static void arm(const double *z, int tool, double *x)
{
    double length = tool ? 1.6 : 1.0;

    x[0] = cos(z[0]) + length * cos(z[0] + z[1]);
    x[1] = sin(z[0]) + length * sin(z[0] + z[1]);
}

static struct learner *taught(const struct learner_config *config)
{
    struct learner *learner = bed_create(config);
    double z[3], x[2];

    for (int n = 0; n < 2000; n++) {
        z[0] = bed_uniform(-0.6, 0.6);
        z[1] = bed_uniform(0.6, 1.6);
        arm(z, n >= 1000, x);
        x[0] += 0.001 * bed_normal();
        x[1] += 0.001 * bed_normal();
        learner_update(learner, z, x);
    }
    return learner;
}

static double forward_error(struct learner *learner, const double *z, const double *x)
{
    double nearest = INFINITY;

    learner_predict(learner, z, &forward);
    for (int k = 0; k < forward.n_solutions; k++)
        nearest = fmin(nearest, hypot(forward.solution[k].value[0] - x[0],
                                      forward.solution[k].value[1] - x[1]));
    return nearest;
}

static void check_inverse(struct learner *learner, double tolerance, int at_least)
{
    double z[2], x[2];
    int good = 0;

    for (int n = 0; n < 100; n++) {
        z[0] = bed_uniform(-0.4, 0.4);
        z[1] = bed_uniform(0.8, 1.4);
        arm(z, n % 2, x);
        ck_assert_int_ge(learner_predict_inverse(learner, x, &inverse), 1);
        bool found = false;
        for (int k = 0; k < inverse.n_solutions; k++)
            found |= forward_error(learner, inverse.solution[k].z, x) < tolerance;
        good += found;
    }
    ck_assert_int_ge(good, at_least);
}

static struct learner_config arm_config(enum learner_features features)
{
    struct learner_config config = learner_config_default(2, 2);

    config.features = features;
    config.reference[1] = 1.1;
    config.psi0[0] = config.psi0[1] = features == LEARNER_LINEAR ? 1e-3 : 1e-4;
    config.sigma0[0] = config.sigma0[1] = features == LEARNER_LINEAR ? 0.05 : 10.0;
    config.hyper_psi = config.prior_psi = INFINITY;
    config.ridge = 1e-4;
    config.p0 = 0.001;
    config.inherit = true;
    config.clustering = LEARNER_CLUSTER_LEADER;
    config.leader_level = 0.9999;
    return config;
}

START_TEST(polynomial_inverse_reaches)
{
    struct learner_config config = arm_config(LEARNER_POLYNOMIAL);

    bed_seed();
    check_inverse(taught(&config), 0.005, 98);
    bed_clean();
}
END_TEST

START_TEST(linear_inverse_comes_near)
{
    struct learner_config config = arm_config(LEARNER_LINEAR);

    bed_seed();
    check_inverse(taught(&config), 0.1, 95);
    bed_clean();
}
END_TEST

/* One linear expert, one input and output: the formula by hand. */
START_TEST(linear_inverse_is_the_published_formula)
{
    struct learner_config config = learner_config_default(1, 1);
    struct learner_solution at;
    double z = 0.0;
    double x = 0.0;

    config.psi0[0] = 1.0;
    config.sigma0[0] = 1.0;
    config.ridge = 1e-6;
    config.p0 = 1e-4;
    config.n_outliers = 0;
    config.hyper_psi = config.prior_psi = INFINITY;
    struct learner *learner = bed_create(&config);
    for (int n = -10; n <= 10; n++) {
        z = 0.1 * n;
        x = 3.0 * z + 1.0;
        learner_update(learner, &z, &x);
    }
    ck_assert_int_eq(learner_get_statistics(learner).experts, 1);
    z = 0.0;
    learner_predict_single(learner, &z, &at);
    x = at.value[0];
    ck_assert_int_eq(learner_predict_inverse(learner, &x, &inverse), 1);
    /* x is the expert's mean, so the centre itself is the answer. */
    ck_assert_double_eq_tol(inverse.solution[0].z[0], 0.0, 1e-3);
    double slope = at.jacobian[0];
    double variance = inverse.solution[0].variance[0];
    double precision_z = 1.0 / variance - slope * slope;
    ck_assert_double_gt(precision_z, 0.0);
    x += 0.5;
    learner_predict_inverse(learner, &x, &inverse);
    ck_assert_double_eq_tol(inverse.solution[0].z[0], variance * slope * 0.5, 1e-3);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        polynomial_inverse_reaches,
        linear_inverse_comes_near,
        linear_inverse_is_the_published_formula,
    };

    return SUITE_RUN("learner inverse", tests);
}
