/* experts: body as a learner: before there is a body, at its borders, on every vector width. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/kernels/kernels.h"
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

enum { JOINTS = 4, WIDTHS = LEARNER_KERNELS_AVX512 + 1 };

static char err[200];
static const double hand[3] = {0.0, 0.0, 0.05}, stick[3] = {0.15, 0.05, -0.1};

static void draw(const struct body *body, int k, double *z, double *x)
{
    random_joints(body, z);
    arm_sample(body, k / 30 % 2 ? stick : hand, z, x);
}

START_TEST(without_a_body_it_is_the_polynomial)
{
    static struct learner_prediction a, b;
    static struct learner_inverse c, d;
    struct learner_config config = body_config(JOINTS, false, 16);

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *ours = bed_create(&config);
    config.features = LEARNER_POLYNOMIAL;
    struct learner *polynomial = bed_create(&config);
    for (int k = 0; k < 400; k++) {
        struct learner_solution one = {0}, other = {0};
        double z[JOINTS], x[3];
        draw(&body, k, z, x);
        memset(&a, 0, sizeof a);
        memset(&b, 0, sizeof b);
        memset(&c, 0, sizeof c);
        memset(&d, 0, sizeof d);
        ck_assert_int_eq(learner_update(ours, z, x), learner_update(polynomial, z, x));
        learner_predict(ours, z, &a);
        learner_predict(polynomial, z, &b);
        learner_predict_single(ours, z, &one);
        learner_predict_single(polynomial, z, &other);
        learner_predict_inverse(ours, x, &c);
        learner_predict_inverse(polynomial, x, &d);
        ck_assert_int_eq(memcmp(&a, &b, sizeof a), 0);
        ck_assert_int_eq(memcmp(&one, &other, sizeof one), 0);
        ck_assert_int_eq(memcmp(&c, &d, sizeof c), 0);
    }
    ck_assert_ptr_null(learner_body(ours));
    ck_assert_int_gt(learner_kept_samples(ours, 0).n, 100);
    ck_assert_int_eq(learner_kept_samples(ours, 1).n, 0);
    ck_assert_int_eq(learner_kept_samples(polynomial, 0).n, 0);
    ck_assert_int_eq(learner_give_body(polynomial, &body, err, sizeof err), -1);
    ck_assert_ptr_nonnull(strstr(err, "experts: body"));
    bed_clean();
}
END_TEST

static void expect_body_refused(struct learner *learner, const struct body *body, const char *why)
{
    ck_assert_int_eq(learner_give_body(learner, body, err, sizeof err), -1);
    ck_assert_msg(strstr(err, why) != NULL, "'%s' does not say '%s'", err, why);
}

START_TEST(what_cannot_be_is_refused)
{
    struct learner_config config = body_config(JOINTS, true, 16);
    const double gross[] = {NAN, INFINITY, -INFINITY, 1e10};
    double z[JOINTS], x[3];

    bed_seed();
    struct body body = made_up_arm(JOINTS, true);
    struct learner *learner = bed_create(&config);
    struct body other = made_up_arm(JOINTS + 1, false);
    body.eyes.law[2] = 0.0; /* one side of some disparity is behind the eyes */
    expect_body_refused(learner, &other, "5 joints");
    for (int k = 0; k < 4; k++) {
        double *const fields[] = {
            &other.chain.middle[1], &other.chain.axis[2][0], &other.chain.offset[0][1],
            &other.noise[2],        &other.length,           &other.gravity[0],
            &other.range[3],        &other.root[7],          &other.eyes.law[1],
            &other.eyes.neck[2],    &other.eyes.angle_unit};
        for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
            other = body;
            *fields[f] = gross[k];
            expect_body_refused(learner, &other, "cannot be used");
        }
    }
    other = body;
    other.noise[1] = 0.0;
    expect_body_refused(learner, &other, "noise");
    ck_assert_ptr_null(learner_body(learner));
    ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
    for (int k = 0; k < 4; k++) {
        draw(&body, 0, z, x);
        z[k] = gross[k];
        ck_assert_int_eq(learner_update(learner, z, x), LEARNER_REFUSED);
        draw(&body, 0, z, x);
        x[k % 3] = gross[k];
        ck_assert_int_eq(learner_update(learner, z, x), LEARNER_REFUSED);
    }
    draw(&body, 0, z, x);
    z[1] = 1e6; /* a number, but no joint */
    ck_assert_int_eq(learner_update(learner, z, x), LEARNER_REFUSED);
    draw(&body, 0, z, x);
    x[2] = -1e4; /* behind the eyes */
    ck_assert_int_eq(learner_update(learner, z, x), LEARNER_OUTLIER);
    ck_assert_int_eq(learner_get_statistics(learner).experts, 0);
    ck_assert_uint_eq(learner_get_statistics(learner).refused, 9);
    bed_clean();
}
END_TEST

START_TEST(three_outputs_are_wanted)
{
    struct learner_config config = body_config(JOINTS, false, 16);

    for (config.n_outputs = 1; config.n_outputs <= LEARNER_MAX_OUTPUTS; config.n_outputs++) {
        for (int i = 0; i < config.n_outputs; i++)
            config.psi0[i] = 1e-4;
        ck_assert_int_eq(learner_config_check(&config, err, sizeof err),
                         config.n_outputs == 3 ? 0 : -1);
        ck_assert(config.n_outputs == 3 || strstr(err, "3 outputs"));
    }
}
END_TEST

/* bed_create() holds what the arena gave against learner_memory(), for every number of joints. */
START_TEST(memory_is_as_it_is_said)
{
    bed_seed();
    for (int n = 1; n <= LEARNER_MAX_INPUTS; n += 3) {
        struct learner_config config = body_config(n, n % 2, 3);
        struct body body = made_up_arm(n, n % 2);
        config.degree = 1;
        struct learner *learner = bed_create(&config);
        ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
        for (int k = 0; k < 100; k++) {
            double z[LEARNER_MAX_INPUTS], x[3];
            draw(&body, k, z, x);
            learner_update(learner, z, x);
        }
        ck_assert_int_ge(learner_get_statistics(learner).experts, 1);
        bed_clean();
    }
}
END_TEST

static int create_all(struct learner_config config, struct learner **learners)
{
    int n = 0;

    for (int width = LEARNER_KERNELS_PLAIN; width < WIDTHS; width++) {
        config.kernels = (enum learner_kernels)width;
        if (kernels_of(config.kernels))
            learners[n++] = bed_create(&config);
    }
    printf("%d widths\n", n);
    return n;
}

START_TEST(all_widths_learn_and_predict_the_same_bytes)
{
    static struct learner_prediction predictions[WIDTHS];
    static struct learner_inverse inverses[WIDTHS];
    struct learner *learners[WIDTHS];

    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        int n = create_all(body_config(JOINTS, sees, 16), learners);
        for (int k = 0; k < 3000; k++) {
            double z[JOINTS], x[3];
            draw(&body, k, z, x);
            memset(predictions, 0, sizeof predictions);
            memset(inverses, 0, sizeof inverses);
            for (int w = 0; w < n; w++) {
                if (k == 40)
                    ck_assert_int_eq(learner_give_body(learners[w], &body, err, sizeof err), 0);
                learner_update(learners[w], z, x);
                learner_predict(learners[w], z, &predictions[w]);
                if (k % 50 == 0)
                    learner_predict_inverse(learners[w], x, &inverses[w]);
                ck_assert_int_eq(memcmp(&predictions[w], &predictions[0], sizeof predictions[0]),
                                 0);
                ck_assert_int_eq(memcmp(&inverses[w], &inverses[0], sizeof inverses[0]), 0);
            }
        }
        for (int w = 1; w < n; w++)
            bed_expect_same_state(learners[0], learners[w]);
        bed_clean();
    }
}
END_TEST

/* Joints that bring each tool to a place; the newest tool's first. */
START_TEST(inverse_solutions_reach)
{
    static struct learner_inverse inverse;
    static struct learner_prediction prediction;
    int reached = 0;

    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct learner_config config = body_config(JOINTS, sees, 16);
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = bed_create(&config);
        ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
        for (int k = 0; k < 120; k++) {
            double z[JOINTS], x[3];
            draw(&body, k, z, x);
            learner_update(learner, z, x);
        }
        for (int k = 0; k < 50; k++) {
            double z[JOINTS], x[3];
            draw(&body, k, z, x);
            int n = learner_predict_inverse(learner, x, &inverse);
            ck_assert_int_le(n, 2);
            for (int s = 0; s < n; s++) {
                double off = 0.0;
                ck_assert(s == 0 || inverse.solution[s].weight <= inverse.solution[s - 1].weight);
                learner_predict(learner, inverse.solution[s].z, &prediction);
                for (int p = 0; p < prediction.n_solutions; p++)
                    if (prediction.solution[p].principal == inverse.solution[s].principal)
                        for (int i = 0; i < 3; i++)
                            off += fabs(prediction.solution[p].value[i] - x[i]) / body.noise[i];
                reached += off < 1.0;
                for (int i = 0; i < JOINTS; i++) {
                    ck_assert_double_ge(inverse.solution[s].variance[i], 0.0);
                    ck_assert_double_le(inverse.solution[s].variance[i],
                                        body.range[i] * body.range[i]);
                }
            }
        }
        bed_clean();
    }
    ck_assert_int_gt(reached, 100); /* of 200: half are out of the other tool's reach at worst */
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        without_a_body_it_is_the_polynomial,
        what_cannot_be_is_refused,
        three_outputs_are_wanted,
        memory_is_as_it_is_said,
        all_widths_learn_and_predict_the_same_bytes,
        inverse_solutions_reach,
    };

    return SUITE_RUN("body learner", tests);
}
