/* What is predicted: one solution for each branch, and Jacobians that are its derivative. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

static struct learner_prediction here, there;

/* A smooth map with two branches; `branch` is 0 or 1. */
static void two_branches(const double *z, int branch, double *x)
{
    x[0] = sin(z[0]) + 0.5 * z[1] * z[1] + 3.0 * branch;
    x[1] = cos(z[1]) - z[0] * z[1] - 2.0 * branch;
}

static struct learner_config robot_like(enum learner_features features,
                                        enum learner_clustering clustering)
{
    struct learner_config config = learner_config_default(2, 2);

    config.features = features;
    config.clustering = clustering;
    config.psi0[0] = config.psi0[1] = 0.01;
    config.sigma0[0] = config.sigma0[1] = features == LEARNER_LINEAR ? 0.05 : 10.0;
    config.scale[0] = config.scale[1] = 2.0;
    config.hyper_psi = config.prior_psi = INFINITY;
    config.ridge = 0.001;
    config.p0 = features == LEARNER_LINEAR ? 0.1 : 0.001;
    config.leader_level = 0.9999;
    config.significance = 0.95;
    return config;
}

static struct learner *taught(const struct learner_config *config, int samples)
{
    struct learner *learner = bed_create(config);
    double z[2], x[2];

    for (int n = 0; n < samples; n++) {
        z[0] = bed_uniform(-1.0, 1.0);
        z[1] = bed_uniform(-1.0, 1.0);
        two_branches(z, n >= samples / 2, x);
        x[0] += 0.01 * bed_normal();
        x[1] += 0.01 * bed_normal();
        learner_update(learner, z, x);
    }
    return learner;
}

static double distance_to_branch(const struct learner_prediction *p, const double *z, int branch)
{
    double nearest = INFINITY;
    double x[2];

    two_branches(z, branch, x);
    for (int k = 0; k < p->n_solutions; k++)
        nearest =
            fmin(nearest, hypot(p->solution[k].value[0] - x[0], p->solution[k].value[1] - x[1]));
    return nearest;
}

static void expect_both_branches(const struct learner_config *config, double tolerance)
{
    struct learner *learner = taught(config, 1000);
    int two = 0;

    for (int n = 0; n < 200; n++) {
        double z[2] = {bed_uniform(-0.9, 0.9), bed_uniform(-0.9, 0.9)};
        two += learner_predict(learner, z, &here) == 2;
        ck_assert_double_lt(distance_to_branch(&here, z, 0), tolerance);
        ck_assert_double_lt(distance_to_branch(&here, z, 1), tolerance);
        ck_assert_double_ge(here.solution[0].weight, here.solution[1].weight);
    }
    ck_assert_int_ge(two, 190);
    bed_clean();
}

START_TEST(each_branch_is_a_solution)
{
    struct learner_config config;

    bed_seed();
    for (int rule = LEARNER_CLUSTER_PUBLISHED; rule <= LEARNER_CLUSTER_LEADER; rule++) {
        config = robot_like(LEARNER_POLYNOMIAL, (enum learner_clustering)rule);
        config.inherit = true;
        config.gamma_floor = 0.05;
        expect_both_branches(&config, 0.06);
    }
    config = robot_like(LEARNER_LINEAR, LEARNER_CLUSTER_PUBLISHED);
    expect_both_branches(&config, 0.5);
}
END_TEST

static bool same_clusters(const struct learner_prediction *a, const struct learner_prediction *b)
{
    if (a->n_solutions != b->n_solutions)
        return false;
    for (int k = 0; k < a->n_solutions; k++)
        if (a->solution[k].members != b->solution[k].members ||
            a->solution[k].principal != b->solution[k].principal)
            return false;
    return true;
}

/* Central differences, where no expert changes its cluster between the two sides. Returns how many
 * columns were compared. */
static int compare_jacobian(struct learner *learner, const double *z)
{
    static struct learner_prediction left;
    const double step = 1e-6;
    int compared = 0;

    learner_predict(learner, z, &here);
    for (int c = 0; c < 2; c++) {
        double up[2] = {z[0], z[1]};
        double down[2] = {z[0], z[1]};
        up[c] += step;
        down[c] -= step;
        learner_predict(learner, up, &there);
        learner_predict(learner, down, &left);
        if (!same_clusters(&here, &there) || !same_clusters(&here, &left))
            continue;
        compared++;
        for (int k = 0; k < here.n_solutions; k++)
            for (int i = 0; i < 2; i++)
                ck_assert_double_eq_tol(
                    here.solution[k].jacobian[i * 2 + c],
                    (there.solution[k].value[i] - left.solution[k].value[i]) / (2.0 * step), 1e-5);
    }
    return compared;
}

START_TEST(jacobian_is_the_derivative)
{
    bed_seed();
    for (int features = LEARNER_LINEAR; features <= LEARNER_POLYNOMIAL; features++)
        for (int rule = LEARNER_CLUSTER_PUBLISHED; rule <= LEARNER_CLUSTER_LEADER; rule++)
            for (int floored = 0; floored < 2; floored++) {
                struct learner_config config =
                    robot_like((enum learner_features)features, (enum learner_clustering)rule);
                config.births = LEARNER_BIRTHS_PUBLISHED;
                config.degree = 2; /* leaves a misfit, so that several experts share a branch */
                config.scale[1] = 0.8;
                config.sigma0[0] = config.sigma0[1] = 0.05;
                config.p0 = 0.1;
                config.gamma_floor = 0.05 * floored;
                struct learner *learner = taught(&config, 600);
                int compared = 0;
                ck_assert_int_gt(learner_get_statistics(learner).experts, 2);
                for (int n = 0; n < 100; n++) {
                    double z[2] = {bed_uniform(-1.2, 1.2), bed_uniform(-1.2, 1.2)};
                    compared += compare_jacobian(learner, z);
                }
                ck_assert_int_gt(compared, 150);
                bed_clean();
            }
}
END_TEST

START_TEST(average_jacobian_is_a_mean_of_slopes)
{
    struct learner_config config = robot_like(LEARNER_POLYNOMIAL, LEARNER_CLUSTER_LEADER);
    double exact = 0.0;
    double z[2] = {0.2, -0.4};

    bed_seed();
    learner_predict(taught(&config, 1000), z, &here);
    exact = here.solution[0].jacobian[0];
    config.average_jacobian = true;
    learner_predict(taught(&config, 1000), z, &there);
    ck_assert_double_eq_tol(there.solution[0].jacobian[0], exact, 0.1);
    ck_assert_double_eq_tol(there.solution[0].jacobian[0], cos(z[0]), 0.1);
    bed_clean();
}
END_TEST

/* sin z and sin z + 1, noise 0.1, or x = z beside x = -z: the published algorithm's own examples.
 * Counts the queries whose branches are 0.3 apart, and returns those with exactly two solutions. */
static int two_of_one_input(bool crossing, int *asked)
{
    struct learner_config config = learner_config_default(1, 1);
    double low = crossing ? -1.0 : -3.0;
    int two = 0;

    config.psi0[0] = 0.01;
    config.sigma0[0] = 0.1;
    config.significance = crossing ? 0.9 : 0.95;
    if (!crossing)
        config.prior_psi = config.hyper_psi = INFINITY;
    struct learner *learner = bed_create(&config);
    for (int n = 0; n < 4000; n++) {
        double z = bed_uniform(low, -low);
        int branch = bed_uniform(0.0, 1.0) < 0.5;
        double x = crossing ? (branch ? z : -z) : sin(z) + branch;
        x += 0.1 * bed_normal();
        learner_update(learner, &z, &x);
    }
    *asked = 0;
    for (int n = 0; n < 200; n++) {
        double z = low + (n + 0.5) / 200.0 * -2.0 * low;
        if (crossing && fabs(z) < 0.15)
            continue;
        (*asked)++;
        two += learner_predict(learner, &z, &here) == 2;
    }
    bed_clean();
    return two;
}

START_TEST(shifted_sines_and_crossing_lines_have_two_values)
{
    int asked = 0;

    bed_seed();
    int sines = two_of_one_input(false, &asked);
    printf("shifted sines: two solutions at %d of %d\n", sines, asked);
    ck_assert_int_eq(sines, asked);
    int lines = two_of_one_input(true, &asked);
    printf("crossing lines: two solutions at %d of %d\n", lines, asked);
    ck_assert_int_ge(lines, asked * 85 / 100);
}
END_TEST

START_TEST(far_away_a_solution_has_no_weight)
{
    struct learner_config config = robot_like(LEARNER_LINEAR, LEARNER_CLUSTER_PUBLISHED);
    struct learner_solution single;
    const double z[2] = {1e6, -1e6};

    bed_seed();
    struct learner *learner = taught(&config, 200);
    ck_assert_int_eq(learner_predict(learner, z, &here), 1);
    ck_assert_double_lt(here.solution[0].weight, 1e-9);
    ck_assert(isfinite(here.solution[0].value[0]));
    ck_assert_int_eq(learner_predict_single(learner, z, &single), 1);
    ck_assert_double_gt(single.variance[0], 1e6);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        each_branch_is_a_solution,
        jacobian_is_the_derivative,
        average_jacobian_is_a_mean_of_slopes,
        shifted_sines_and_crossing_lines_have_two_values,
        far_away_a_solution_has_no_weight,
    };

    return SUITE_RUN("learner prediction", tests);
}
