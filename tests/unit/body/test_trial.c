/* A body that explains badly is on trial beside polynomials, and given up when they do better. */
#include <math.h>
#include <string.h>

#include "learner/body/change/contest.h"
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

enum { JOINTS = 3 };

static char err[200];

/* Of rounds of 500 the last 50 are withheld, and 25 of these count. */
START_TEST(the_better_one_wins)
{
    struct contest contest = contest_begin();
    int withheld = 0, counted = 0;

    for (int k = 0; k < 2000; k++) {
        withheld += contest_withholds(&contest);
        counted += contest_counts(&contest);
        ck_assert(!contest_counts(&contest) || contest_withholds(&contest));
        contest_add(&contest, 9.0, 10.0);
        ck_assert(!contest_lost(&contest)); /* not clearly */
    }
    ck_assert_int_eq(withheld, 200);
    ck_assert_int_eq(counted, 100);
    for (int k = 0; k < 2000; k++)
        contest_add(&contest, 4.0, 10.0);
    ck_assert(contest_lost(&contest));
    ck_assert_double_eq_tol(contest.body, 10.0, 1e-9);
    ck_assert_double_eq_tol(contest.polynomial, 4.0, 1.0);
}
END_TEST

/* No chain, and more than the remainder of a context: polynomials of the third degree. */
static void bent(const double *z, double *x)
{
    for (int k = 0; k < 3; k++)
        x[k] = 0.1 * z[k] + 0.2 * z[0] * z[1] * z[2] + 0.1 * z[k] * z[k] * z[(k + 1) % 3];
}

static void teach(struct learner *learner, const struct body *range, int samples)
{
    for (int s = 0; s < samples; s++) {
        double z[JOINTS], x[3];
        random_joints(range, z);
        bent(z, x);
        for (int k = 0; k < 3; k++)
            x[k] += ARM_NOISE * bed_normal();
        learner_update(learner, z, x);
    }
}

static double error_of(struct learner *learner, const struct body *range)
{
    double sum = 0.0;

    for (int s = 0; s < 200; s++) {
        struct learner_solution one = {0};
        double z[JOINTS], x[3];
        random_joints(range, z);
        bent(z, x);
        ck_assert_int_eq(learner_predict_single(learner, z, &one), 1);
        for (int k = 0; k < 3; k++)
            sum += pow(one.value[k] - x[k], 2) / 600;
    }
    return sqrt(sum);
}

START_TEST(a_body_that_is_none_is_given_up)
{
    struct learner_config config = body_config(JOINTS, false, 16);

    bed_seed();
    config.degree = 3;
    config.noise_share = ARM_NOISE * ARM_NOISE / config.psi0[0];
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = bed_create(&config);
    config.features = LEARNER_POLYNOMIAL;
    struct learner *polynomial = bed_create(&config);
    body.error = 9.0;
    for (int k = 0; k < 3; k++)
        body.noise[k] = 9.0 * ARM_NOISE;
    teach(learner, &body, 300);
    ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
    ck_assert_ptr_nonnull(learner_body(learner));
    teach(learner, &body, 8000);
    ck_assert_ptr_null(learner_body(learner));
    teach(polynomial, &body, 8000);
    ck_assert_double_lt(error_of(learner, &body), 2.0 * error_of(polynomial, &body));
    ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "polynomials"));
    body.error = 0.9; /* one that says that it explains all is believed */
    ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
    bed_clean();
}
END_TEST

/* Badly, and better than polynomials, is well enough. */
START_TEST(a_body_that_is_better_stays)
{
    struct learner_config config = body_config(JOINTS, false, 16);

    bed_seed();
    config.noise_share = ARM_NOISE * ARM_NOISE / config.psi0[0];
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = bed_create(&config);
    const double tip[3] = {0.3, 0.1, 0.2};
    body.error = 9.0; /* of a noise told too low */
    ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
    for (int s = 0; s < 4000; s++) {
        double z[JOINTS], x[3];
        random_joints(&body, z);
        arm_sample(&body, tip, z, x);
        for (int k = 0; k < 3; k++)
            x[k] += 9.0 * ARM_NOISE * bed_normal();
        learner_update(learner, z, x);
    }
    ck_assert_ptr_nonnull(learner_body(learner));
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        the_better_one_wins,
        a_body_that_is_none_is_given_up,
        a_body_that_is_better_stays,
    };

    return SUITE_RUN("trial", tests);
}
