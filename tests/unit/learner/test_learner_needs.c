/* Births by evidence: who is still needed. */
#include <math.h>

#include "branches.h"
#include "tests/unit/suite.h"

/* As in etc/reach-learner.yaml. */
static struct learner_config curve(void)
{
    struct learner_config config = learner_config_default(1, 1);

    config.features = LEARNER_POLYNOMIAL;
    config.degree = 5;
    config.clustering = LEARNER_CLUSTER_LEADER;
    config.hyper_psi = config.prior_psi = INFINITY;
    config.ridge = 1e-4;
    config.inherit = true;
    config.psi0[0] = 0.01;
    config.sigma0[0] = 10.0;
    config.scale[0] = 1.5;
    return config;
}

static double curve_at(double z, bool upper)
{
    return upper ? 2.5 + 0.5 * z : sin(z);
}

START_TEST(two_curves_by_chance_from_the_start_are_told_apart)
{
    const struct learner_config config = curve();
    struct learner *learner = bed_create(&config);
    int two = 0;

    bed_seed();
    for (int k = 0; k < 600; k++) {
        double z = bed_uniform(-3.0, 3.0);
        double x = curve_at(z, bed_uniform(0.0, 1.0) < 0.5) + 0.03 * bed_normal();
        learner_update(learner, &z, &x);
    }
    for (int k = 0; k <= 100; k++) {
        double z = -3.0 + 0.06 * k;
        struct learner_prediction prediction;
        two += learner_predict(learner, &z, &prediction) == 2;
        for (int upper = 0; upper < 2; upper++) {
            double x = curve_at(z, upper == 1);
            ck_assert_double_lt(bed_square_off(learner, &z, &x, 1), 0.25 * 0.25);
        }
    }
    ck_assert_int_ge(two, 80);
    bed_clean();
}
END_TEST

/* By chance from the start, and one outlier is enough: some experts learn a piece of both. */
START_TEST(what_the_others_know_goes)
{
    struct learner_config config = branches_cubic(16);

    bed_seed();
    config.n_outliers = 1;
    for (int draw = 0; draw < 8; draw++) {
        struct learner *learner = bed_create(&config);
        for (int k = 0; k < 1500; k++)
            branches_teach(learner, 1, bed_uniform(0.0, 1.0) < 0.5, NULL);
        ck_assert_int_eq(branches_experts(learner), 2);
        for (int branch = 0; branch < 2; branch++)
            ck_assert_double_lt(branches_error_of(learner, branch), 0.2 * branches_tolerance);
    }
    bed_clean();
}
END_TEST

START_TEST(what_is_known_alone_stays_however_long_unused)
{
    struct learner_config config = branches_cubic(16);

    bed_seed();
    struct learner *learner = bed_create(&config);
    branches_teach(learner, 400, 0.0, NULL);
    branches_teach(learner, 400, 1.0, NULL);
    double before = branches_error_of(learner, 0.0);
    branches_teach(learner, 8000, 2.0, NULL);
    ck_assert_int_eq(branches_experts(learner), 3);
    ck_assert_double_lt(fabs(branches_error_of(learner, 0.0) - before), 1e-12);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        two_curves_by_chance_from_the_start_are_told_apart,
        what_the_others_know_goes,
        what_is_known_alone_stays_however_long_unused,
    };

    return SUITE_RUN("experts that are needed", tests);
}
