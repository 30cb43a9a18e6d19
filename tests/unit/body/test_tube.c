/* A tool that gives way to gravity, and the exact Jacobians of rigid ones and of such. */
#include <math.h>

#include "learner/body/chain/vec3.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"
#include "tools_bed.h"

static struct learner_prediction prediction;

/* The end of a tube: it gives way to gravity, as the hand feels it. */
static const double tube_tip[3] = {0.15, 0.02, 0.05};
static const double tube_droop[9] = {0.03, 0.0, 0.01, 0.0, 0.04, 0.0, -0.01, 0.0, 0.02};

/* One that bends across itself alone, as far in all directions; from the hand on. */
static const double hand_tip[3] = {0.0, 0.0, 0.05};
static const double beam_droop[9] = {0.0007, -0.0052, 0.0, -0.0052, 0.0393, 0.0, 0.0, 0.0, 0.04};

static const double *droop = tube_droop;

static void tube_at(const struct body *body, const double *z, double *tip)
{
    struct chain_pose pose;
    double felt[3];

    chain_at(&body->chain, z, &pose);
    mat3_apply_transposed(pose.turn[JOINTS], body->gravity, felt);
    mat3_apply(droop, felt, tip);
    vec3_add(1.0, tube_tip, tip);
}

static void teach_tube(struct learner *learner, const struct body *body, int samples)
{
    for (int s = 0; s < samples; s++) {
        double z[JOINTS], x[3], tip[3];
        random_joints(body, z);
        tube_at(body, z, tip);
        if (arm_sample(body, tip, z, x))
            learner_update(learner, z, x);
    }
}

/* rms over random postures of the tube, in units of the noise. */
static double tube_misfit(struct learner *learner, const struct body *body)
{
    double sum = 0.0;
    int n = 0;

    for (int s = 0; s < 100; s++) {
        double z[JOINTS], x[3], tip[3];
        random_joints(body, z);
        tube_at(body, z, tip);
        if (!arm_output(body, tip, z, x) || !learner_predict(learner, z, &prediction))
            continue;
        sum += nearest_square(&prediction, body, x);
        n++;
    }
    return sqrt(sum / n);
}

START_TEST(a_tube_is_one_tool)
{
    const double hand[3] = {0.0, 0.0, 0.05};

    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = on_body(&body, 16);
        teach(learner, &body, hand, 50);
        teach_tube(learner, &body, 40);
        ck_assert_double_lt(tube_misfit(learner, &body), 4.0);
        teach_tube(learner, &body, 100);
        ck_assert_int_eq(experts(learner), 2);
        ck_assert_double_lt(tube_misfit(learner, &body), 1.5);
        ck_assert_double_lt(misfit(learner, &body, hand), 1.0);
        ck_assert(learner_kept_samples(learner, 0).rigid);
        ck_assert(!learner_kept_samples(learner, 1).rigid);
        bed_clean();
    }
}
END_TEST

/* What is long bends across itself: that much is expected of it, and few samples tell the rest. */
START_TEST(few_samples_tell_a_beam)
{
    enum { DRAWS = 40 };
    int close = 0;

    bed_seed();
    droop = beam_droop;
    for (int draw = 0; draw < DRAWS; draw++) {
        struct body body = made_up_arm(JOINTS, false);
        struct learner *learner = on_body(&body, 16);
        teach(learner, &body, hand_tip, 50);
        teach_tube(learner, &body, 3);
        close += tube_misfit(learner, &body) < 12.0;
        bed_clean();
    }
    droop = tube_droop;
    ck_assert_int_gt(close, 3 * DRAWS / 4);
}
END_TEST

/* Against differences of the prediction, whatever size of a design answers. */
static void expect_exact_jacobian(struct learner *learner, const struct body *body)
{
    static struct learner_prediction behind, ahead;
    const double step = 1e-6;
    double z[JOINTS];

    random_joints(body, z);
    learner_predict(learner, z, &prediction);
    for (int i = 0; i < JOINTS; i++) {
        double here = z[i];
        z[i] = here - step;
        learner_predict(learner, z, &behind);
        z[i] = here + step;
        learner_predict(learner, z, &ahead);
        z[i] = here;
        ck_assert_int_eq(behind.n_solutions, prediction.n_solutions);
        for (int s = 0; s < prediction.n_solutions; s++)
            for (int r = 0; r < 3; r++) {
                double slope =
                    (ahead.solution[s].value[r] - behind.solution[s].value[r]) / (2.0 * step);
                double ours = prediction.solution[s].jacobian[r * JOINTS + i];
                ck_assert_double_eq_tol(ours, slope, 2e-6 * (1.0 + fabs(slope)));
            }
    }
}

START_TEST(jacobians_are_those_of_the_prediction)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++)
        for (int droops = 0; droops < 2; droops++) {
            struct body body = made_up_arm(JOINTS, sees);
            body.chain.slides[1] = true;
            struct learner *learner = on_body(&body, 16);
            if (droops)
                teach_tube(learner, &body, 300);
            else
                teach(learner, &body, tube_tip, 300);
            ck_assert_int_eq(learner_kept_samples(learner, 0).rigid, !droops);
            for (int k = 0; k < 20; k++)
                expect_exact_jacobian(learner, &body);
            bed_clean();
        }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_tube_is_one_tool, few_samples_tell_a_beam,
                                  jacobians_are_those_of_the_prediction};

    return SUITE_RUN("tube", tests);
}
