/* What locally weighted projection regression learns: a surface, a change, an arm's kinematics. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "tests/unit/suite.h"

static struct learner_solution solution;

static struct learner_config config_for(int n_inputs, int n_outputs)
{
    struct learner_config config = learner_config_default(n_inputs, n_outputs);

    config.kind = LEARNER_LWPR;
    return config;
}

/* The surface of the paper's section 4.1: two ridges and a bump. */
static double cross(const double *z)
{
    double ridge = fmax(exp(-10.0 * z[0] * z[0]), exp(-50.0 * z[1] * z[1]));

    return fmax(ridge, 1.25 * exp(-5.0 * (z[0] * z[0] + z[1] * z[1])));
}

/* RMSE against the noise-free surface after 20,000 samples with noise 0.1. */
static double error_on_cross(double init_d, double init_alpha, int *fields)
{
    struct learner_config config = config_for(2, 1);
    double sum = 0.0;

    config.capacity = 1024;
    config.lwpr.init_d = init_d;
    config.lwpr.init_alpha = init_alpha;
    struct learner *learner = bed_create(&config);
    for (int n = 0; n < 20000; n++) {
        double z[2] = {bed_uniform(-1.0, 1.0), bed_uniform(-1.0, 1.0)};
        double x = cross(z) + 0.1 * bed_normal();
        learner_update(learner, z, &x);
    }
    *fields = learner_get_statistics(learner).experts;
    for (int n = 0; n < 2000; n++) {
        double z[2] = {bed_uniform(-1.0, 1.0), bed_uniform(-1.0, 1.0)};
        learner_predict_single(learner, z, &solution);
        sum += pow(solution.value[0] - cross(z), 2);
    }
    bed_clean();
    return sqrt(sum / 2000.0);
}

/* Over three draws, since a single field that widens in its first samples spoils a draw. */
START_TEST(metrics_are_learned)
{
    double fixed = 0.0, learned = 0.0;
    int kept, narrowed, fields;

    bed_seed();
    for (int n = 0; n < 3; n++) {
        fixed += error_on_cross(30.0, 0.0, &kept) / 3.0;
        learned += error_on_cross(30.0, 250.0, &narrowed) / 3.0;
        ck_assert_int_gt(narrowed, kept);
    }
    double fine = error_on_cross(100.0, 250.0, &fields);
    printf("RMSE on the cross: init_d 30 and kept %.3f (%d fields), learned %.3f (%d); "
           "init_d 100 %.3f (%d)\n",
           fixed, kept, learned, narrowed, fine, fields);
    ck_assert_double_lt(learned, 0.9 * fixed);
    ck_assert_double_lt(fine, 0.06);
}
END_TEST

static double value_after_change(double lambda, double *variance)
{
    struct learner_config config = config_for(1, 1);
    const double query = 0.1;

    config.lwpr.init_lambda = config.lwpr.final_lambda = lambda;
    config.lwpr.init_alpha = 0.0;
    struct learner *learner = bed_create(&config);
    for (int n = 0; n < 10000; n++) {
        double z = bed_uniform(-1.0, 1.0);
        double x = sin(z) + (n < 6000 ? 0.0 : 1.0) + 0.01 * bed_normal();
        learner_update(learner, &z, &x);
    }
    learner_predict_single(learner, &query, &solution);
    *variance = solution.variance[0];
    bed_clean();
    return solution.value[0];
}

START_TEST(what_is_no_longer_true_is_forgotten)
{
    double variance;

    bed_seed();
    ck_assert_double_eq_tol(value_after_change(0.995, &variance), sin(0.1) + 1.0, 0.05);
    ck_assert_double_lt(variance, 0.01);
    ck_assert_double_eq_tol(value_after_change(1.0, &variance), sin(0.1) + 0.4, 0.1);
}
END_TEST

/* Near data the variance is that of the noise, far away it is large. */
START_TEST(confidence_is_lost_with_distance)
{
    struct learner_config config = config_for(1, 1);
    double near = 0.0, far = 2.0, farther = 30.0;

    bed_seed();
    config.lwpr.w_gen = 0.5;
    struct learner *learner = bed_create(&config);
    for (int n = 0; n < 20000; n++) {
        double z = bed_uniform(-1.0, 1.0);
        double x = 2.0 * z + 0.1 * bed_normal();
        learner_update(learner, &z, &x);
    }
    learner_predict_single(learner, &near, &solution);
    ck_assert_double_gt(solution.weight, 0.5);
    ck_assert_double_gt(solution.variance[0], 0.25 * 0.01);
    ck_assert_double_lt(solution.variance[0], 2.0 * 0.01);
    double variance = solution.variance[0];
    learner_predict_single(learner, &far, &solution);
    ck_assert_double_gt(solution.variance[0], 10.0 * variance);
    ck_assert_double_lt(solution.weight, 0.1);
    ck_assert_double_eq_tol(solution.value[0], 4.0, 0.3);
    learner_predict_single(learner, &farther, &solution);
    ck_assert(isinf(solution.variance[0]) && isfinite(solution.value[0]));
    bed_clean();
}
END_TEST

/* An arm on a waist, 7 joints: the kinematics of the reference measurements in docs/lwpr.md. */
enum { JOINTS = 7 };
static const double joint_min[JOINTS] = {-30, -30, -10, -80, 0, 0, 20}; /* deg */
static const double joint_max[JOINTS] = {30, 30, 30, 0, 80, 80, 80};
static const double degree = 3.14159265358979323846 / 180.0;

/* Turns p about axis 0, 1 or 2, right-handed. */
static void rotate(int axis, double angle, double *p)
{
    int i = (axis + 1) % 3, k = (axis + 2) % 3;
    double c = cos(angle), s = sin(angle), a = p[i], b = p[k];

    p[i] = c * a - s * b;
    p[k] = s * a + c * b;
}

static void hand_position(const double *q, double *p)
{
    enum { X, Y, Z };
    const double rotations[JOINTS][2] = {{Z, 1}, {X, 1}, {Y, 1}, {Y, 1}, {X, -1}, {Z, -1}, {Y, -1}};

    p[0] = p[1] = 0.0;
    p[2] = -0.197;
    for (int joint = JOINTS - 1; joint >= 0; joint--) {
        rotate((int)rotations[joint][0], rotations[joint][1] * q[joint], p);
        if (joint == 5)
            p[2] += -0.152;
        if (joint == 3) {
            p[1] += -0.11;
            p[2] += 0.18;
        }
    }
}

static void random_posture(double *q)
{
    for (int i = 0; i < JOINTS; i++)
        q[i] = degree * bed_uniform(joint_min[i], joint_max[i]);
}

/* Moves joints towards the goal at their speeds for 20 ms; a new goal when all have arrived. */
static void walk(double *q, double *goal, double *speed)
{
    bool moving = false;

    for (int i = 0; i < JOINTS; i++) {
        double left = goal[i] - q[i], most = 0.02 * speed[i];
        q[i] += fmax(fmin(left, most), -most);
        moving = moving || fabs(left) > most;
    }
    if (moving)
        return;
    random_posture(goal);
    for (int i = 0; i < JOINTS; i++)
        speed[i] = degree * bed_uniform(20.0, 40.0);
}

/* Mean of the three components' RMSE on uniform postures, mm. */
static double error_of_hand(struct learner *learner)
{
    double sum[3] = {0}, q[JOINTS], p[3];

    for (int n = 0; n < 3000; n++) {
        random_posture(q);
        hand_position(q, p);
        learner_predict_single(learner, q, &solution);
        for (int o = 0; o < 3; o++)
            sum[o] += pow(1000.0 * (solution.value[o] - p[o]), 2);
    }
    return (sqrt(sum[0] / 3000.0) + sqrt(sum[1] / 3000.0) + sqrt(sum[2] / 3000.0)) / 3.0;
}

/* Fields and errors of the LWPR library on three such streams are in docs/lwpr.md: 107 fields and
 * 48.8 mm after 5,000 samples, 220 and 33.3 after 20,000. */
START_TEST(an_arm_is_learned_as_well_as_by_the_library)
{
    struct learner_config config = config_for(JOINTS, 3);
    double q[JOINTS], goal[JOINTS], speed[JOINTS] = {0}, p[3];

    bed_seed();
    config.capacity = 1024;
    struct learner *learner = bed_create(&config);
    random_posture(q);
    memcpy(goal, q, sizeof q);
    for (int n = 1; n <= 20000; n++) {
        walk(q, goal, speed);
        hand_position(q, p);
        for (int o = 0; o < 3; o++)
            p[o] += 0.0005 * bed_normal();
        learner_update(learner, q, p);
        if (n != 5000 && n != 20000)
            continue;
        int fields = learner_get_statistics(learner).experts;
        double error = error_of_hand(learner);
        printf("%d samples: %d fields, %.1f mm\n", n, fields, error);
        ck_assert_double_eq_tol(fields, n == 5000 ? 107 : 220, n == 5000 ? 27 : 55);
        ck_assert_double_lt(error, 1.15 * (n == 5000 ? 48.8 : 33.3));
    }
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        metrics_are_learned,
        what_is_no_longer_true_is_forgotten,
        confidence_is_lost_with_distance,
        an_arm_is_learned_as_well_as_by_the_library,
    };

    return SUITE_RUN("lwpr learning", tests);
}
