/* Tools on a body that is given, through learner.h alone: how they are born, kept apart, and left.
 */
#include <math.h>

#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"
#include "tools_bed.h"

static struct learner_prediction prediction;
static char err[160];

START_TEST(a_tool_is_known_after_a_few_samples)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = on_body(&body, 16);
        const double hand[3] = {0.0, 0.0, 0.05}, stick[3] = {0.12, 0.05, -0.1};
        teach(learner, &body, hand, 30);
        ck_assert_int_eq(experts(learner), 1);
        ck_assert_double_lt(misfit(learner, &body, hand), 1.0);
        teach(learner, &body, stick, 5);
        ck_assert_int_eq(experts(learner), 2);
        ck_assert_double_lt(misfit(learner, &body, stick), 4.0);
        teach(learner, &body, stick, 100);
        ck_assert_double_lt(misfit(learner, &body, stick), 0.6);
        ck_assert_double_lt(misfit(learner, &body, hand), 1.0); /* not forgotten */
        ck_assert_int_eq(experts(learner), 2);
        ck_assert_uint_eq(learner_get_statistics(learner).births, 2);
        bed_clean();
    }
}
END_TEST

/* In turns, sample by sample: each has its own, and every posture as many answers. */
START_TEST(tools_in_turns_are_kept_apart)
{
    enum { TOOLS = 4 };
    double tips[TOOLS][3];
    double weights = 0.0;
    double z[JOINTS];

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = on_body(&body, 16);
    for (int k = 0; k < TOOLS; k++)
        random_tip(tips[k]);
    for (int k = 0; k < TOOLS; k++)
        teach(learner, &body, tips[k], 6);
    for (int s = 0; s < 400; s++)
        teach(learner, &body, tips[s % TOOLS], 1);
    ck_assert_int_eq(experts(learner), TOOLS);
    for (int k = 0; k < TOOLS; k++)
        ck_assert_double_lt(misfit(learner, &body, tips[k]), 1.0);
    random_joints(&body, z);
    ck_assert_int_eq(learner_predict(learner, z, &prediction), TOOLS);
    for (int k = 0; k < TOOLS; k++) {
        weights += prediction.solution[k].weight;
        ck_assert(k == 0 || prediction.solution[k].weight <= prediction.solution[k - 1].weight);
    }
    ck_assert_double_eq_tol(weights, 1.0, 1e-12);
    bed_clean();
}
END_TEST

/* Nobody can tell them apart at first: what was made of several is left over. */
START_TEST(tools_in_turns_from_the_first_sample_are_known)
{
    enum { TOOLS = 4 };
    double tips[TOOLS][3];
    int known = 0;

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = on_body(&body, 16);
    for (int k = 0; k < TOOLS; k++)
        random_tip(tips[k]);
    for (int s = 0; s < 400; s++)
        teach(learner, &body, tips[s % TOOLS], 1);
    ck_assert_int_le(experts(learner), TOOLS + 3);
    for (int k = 0; k < TOOLS; k++)
        known += misfit(learner, &body, tips[k]) < 1.0;
    ck_assert_int_ge(known, TOOLS - 1); /* one may be lost in that: some one time in ten */
    bed_clean();
}
END_TEST

/* As many as are wanted, the strongest. */
START_TEST(the_strongest_are_answered)
{
    double tips[3][3];
    double z[JOINTS], x[3];

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner_config config = body_config(JOINTS, false, 16);
    config.n_solutions_max = 1;
    struct learner *learner = bed_create(&config);
    ck_assert_int_eq(learner_give_body(learner, &body, err, sizeof err), 0);
    for (int k = 0; k < 3; k++) {
        random_tip(tips[k]);
        teach(learner, &body, tips[k], 60);
    }
    random_joints(&body, z);
    arm_output(&body, tips[2], z, x);
    ck_assert_int_eq(learner_predict(learner, z, &prediction), 1);
    ck_assert_double_eq(prediction.solution[0].weight, 1.0);
    for (int i = 0; i < 3; i++)
        ck_assert_double_eq_tol(prediction.solution[0].value[i], x[i], 10.0 * body.noise[i]);
    bed_clean();
}
END_TEST

static void gross_error(struct learner *learner, const struct body *body)
{
    double z[JOINTS], x[3], tip[3];

    random_joints(body, z);
    random_tip(tip);
    if (arm_sample(body, tip, z, x))
        learner_update(learner, z, x);
}

START_TEST(gross_errors_leave_nothing_behind)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++)
        for (int run = 1; run <= 10; run += 9) {
            struct body body = made_up_arm(JOINTS, sees);
            struct learner *learner = on_body(&body, 16);
            const double tip[3] = {0.1, -0.05, 0.05};
            teach(learner, &body, tip, 50);
            for (int k = 0; k < 20; k++) {
                for (int e = 0; e < run; e++)
                    gross_error(learner, &body);
                teach(learner, &body, tip, 40);
                ck_assert_int_eq(experts(learner), 1);
            }
            ck_assert_double_lt(misfit(learner, &body, tip), 1.0);
            bed_clean();
        }
}
END_TEST

/* A run of samples in which something else was taken for the ball is a tool at first, and goes; one
 * that was in use for a second stays. */
START_TEST(what_was_seen_for_a_moment_is_forgotten)
{
    const double tip[3] = {0.1, -0.05, 0.05}, tool[3] = {-0.2, 0.1, 0.0};

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = on_body(&body, 16);
    teach(learner, &body, tip, 100);
    teach(learner, &body, tool, 50);
    for (int run = 0; run < 5; run++) {
        double wrong[3];
        random_tip(wrong);
        teach(learner, &body, wrong, 10);
        teach(learner, &body, tip, 100);
    }
    ck_assert_int_gt(experts(learner), 4);
    teach(learner, &body, tip, 1100);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_double_lt(misfit(learner, &body, tool), 1.0);
    bed_clean();
}
END_TEST

/* A tool that moved through where another is: there were two contexts of one tool, then. */
START_TEST(two_contexts_of_one_tool_become_one)
{
    const double from[3] = {0.1, 0.0, 0.0}, to[3] = {0.1, 0.012, 0.0};
    double half[3];

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = on_body(&body, 16);
    teach(learner, &body, from, 3);
    teach(learner, &body, to, 60);
    ck_assert_int_eq(experts(learner), 2);
    for (int s = 0; s < 30000 && experts(learner) > 1; s++) { /* it slips slowly */
        for (int k = 0; k < 3; k++)
            half[k] = to[k] + (from[k] - to[k]) * fmin(s / 20000.0, 1.0);
        teach(learner, &body, half, 1);
    }
    ck_assert_int_eq(experts(learner), 1);
    bed_clean();
}
END_TEST

/* The least used of all makes room, when the newest is confirmed and not before; the others stay.
 */
START_TEST(a_full_model_makes_room)
{
    enum { MOST = 4 };
    double tips[MOST + 1][3];

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = on_body(&body, MOST);
    for (int k = 0; k <= MOST; k++)
        random_tip(tips[k]);
    for (int k = 0; k < MOST; k++)
        teach(learner, &body, tips[k], 60);
    for (int k = 0; k < 50; k++)
        gross_error(learner, &body);
    for (int k = 0; k < MOST; k++)
        ck_assert_double_lt(misfit(learner, &body, tips[k]), 1.0);
    ck_assert_int_le(experts(learner), MOST);
    teach(learner, &body, tips[MOST], 60);
    ck_assert_int_eq(experts(learner), MOST);
    ck_assert_double_gt(misfit(learner, &body, tips[0]), 10.0);
    for (int k = 1; k <= MOST; k++)
        ck_assert_double_lt(misfit(learner, &body, tips[k]), 1.0);
    bed_clean();
}
END_TEST

START_TEST(one_place_serves_the_newest_tool)
{
    const double hand[3] = {0.0, 0.0, 0.05}, stick[3] = {0.2, 0.05, -0.1};

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = on_body(&body, 1);
    teach(learner, &body, hand, 60);
    gross_error(learner, &body);
    ck_assert_double_lt(misfit(learner, &body, hand), 1.0);
    teach(learner, &body, stick, 60);
    ck_assert_double_lt(misfit(learner, &body, stick), 1.0);
    ck_assert_int_eq(experts(learner), 1);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_tool_is_known_after_a_few_samples,
        tools_in_turns_are_kept_apart,
        tools_in_turns_from_the_first_sample_are_known,
        the_strongest_are_answered,
        gross_errors_leave_nothing_behind,
        what_was_seen_for_a_moment_is_forgotten,
        two_contexts_of_one_tool_become_one,
        a_full_model_makes_room,
        one_place_serves_the_newest_tool,
    };

    return SUITE_RUN("contexts", tests);
}
