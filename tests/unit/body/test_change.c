/* A body that changes while it is in use: a joint's zero, the eyes, a tool that slips. Noticed,
 * told, followed, and the tools that were not in use keep their tips. */
#include <math.h>

#include "learner/body/chain/vec3.h"
#include "learner/body/change/change.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"
#include "tools_bed.h"

static const double hand[3] = {0.0, 0.0, 0.05}, stick[3] = {0.12, 0.05, -0.1};
static const double degree = M_PI / 180;

/* The arm whose encoders all read the same as before, with joint i's zero off by that much. */
static struct body with_zero(const struct body *body, int joint, double by)
{
    struct body moved = *body;

    moved.chain.middle[joint] -= by;
    return moved;
}

/* Of the joints but the last, the one that moves the hand most: random arms have such that do not.
 */
static int most_moving(const struct body *body)
{
    double most = 0.0;
    int best = 0;

    for (int i = 0; i + 1 < JOINTS; i++) {
        double sum = 0.0;
        for (int k = 0; k < 50; k++) {
            struct body moved = with_zero(body, i, 0.01);
            double z[JOINTS], x[3], y[3];
            random_joints(body, z);
            if (!arm_output(body, hand, z, x) || !arm_output(&moved, hand, z, y))
                continue;
            for (int r = 0; r < 3; r++)
                sum += pow((x[r] - y[r]) / body->noise[r], 2);
        }
        if (sum > most) {
            most = sum;
            best = i;
        }
    }
    return best;
}

static struct learner *with_two_tools(const struct body *body)
{
    struct learner *learner = on_body(body, 16);

    teach(learner, body, hand, 500);
    teach(learner, body, stick, 500);
    teach(learner, body, hand, 100);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_int_eq(learner_get_body_change(learner).cause, -1);
    return learner;
}

/* What is seen of the columns: what a sample leaves of the body of before. */
static void residual(const struct body *before, const double *z, const double *tip, const double *x,
                     double *y)
{
    struct chain_pose pose;
    double place[3], white[9], turned[3];

    ck_assert(body_place(before, x, place, white));
    chain_at(&before->chain, z, &pose);
    mat3_apply(pose.turn[before->chain.n], tip, turned);
    vec3_add(-1.0, pose.p, place);
    vec3_add(-1.0, turned, place);
    mat3_apply(white, place, y);
}

/* Each column against samples of a body that has changed by a little of it. */
START_TEST(columns_are_what_a_changed_body_shows)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        for (int cause = 0; cause <= JOINTS; cause++)
            for (int k = 0; k < (cause < JOINTS ? 1 : CHANGE_VIEW); k++) {
                struct change_story story = {.cause = cause};
                struct chain_pose pose;
                struct body after = body;
                double z[JOINTS], x[3], old[3], y[3], place[3], white[9], rows[3 * CHANGE_MAX];
                int m = change_columns(JOINTS);
                story.c[k] = 1e-5;
                change_apply(&story, &after);
                random_joints(&body, z);
                ck_assert(arm_output(&after, hand, z, x));
                residual(&body, z, hand, x, y);
                ck_assert(body_place(&body, x, place, white));
                chain_at(&body.chain, z, &pose);
                ck_assert(change_rows(&body, &pose, place, x, white, rows));
                double size = 0.0;
                for (int r = 0; r < 3; r++)
                    size = fmax(size, fabs(rows[r * m + cause + k]));
                for (int r = 0; r < 3; r++)
                    ck_assert_double_eq_tol(y[r] / 1e-5, rows[r * m + cause + k], 2e-3 * size);
                /* A sample of before becomes one of after. */
                ck_assert(arm_output(&body, hand, z, old));
                change_sample(&story, &body, z, old);
                residual(&after, z, hand, old, y);
                ck_assert_double_lt(vec3_length(y), 1e-3 * 1e-5 * size);
            }
        bed_clean();
    }
}
END_TEST

static void expect_joint(const struct learner *learner, int joint)
{
    struct learner_body_change change = learner_get_body_change(learner);

    ck_assert_uint_ge(change.changes, 1);
    ck_assert_int_eq(change.cause, joint);
    ck_assert(change.by[1] == 0.0 && change.by[2] == 0.0);
}

/* The stick is not touched again, and is right all the same. */
START_TEST(a_zero_that_moves_slowly_is_followed)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = with_two_tools(&body);
        const int joint = most_moving(&body);
        const double by = (sees ? 4 : 1) * degree; /* links are short before eyes */
        struct body moved = with_zero(&body, joint, by);
        const double before = misfit(learner, &moved, stick); /* if nobody noticed */
        for (int s = 0; s < 10000; s++) {
            struct body now = with_zero(&body, joint, by * s / 10000.0);
            teach(learner, &now, hand, 1);
        }
        teach(learner, &moved, hand, 1000);
        expect_joint(learner, joint);
        ck_assert_int_eq(experts(learner), 2);
        ck_assert_double_lt(misfit(learner, &moved, hand), 1.0);
        ck_assert_double_gt(before, 4.0);
        ck_assert_double_lt(misfit(learner, &moved, stick), 0.4 * before);
        double off = learner_body(learner)->chain.middle[joint] - moved.chain.middle[joint];
        ck_assert_double_lt(fabs(off), 0.4 * by); /* what is left is under the noise */
        bed_clean();
    }
}
END_TEST

START_TEST(a_zero_that_jumps_is_followed)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = with_two_tools(&body);
        const int joint = most_moving(&body);
        const double by = (sees ? 4 : 1) * degree; /* links are short before eyes */
        struct body moved = with_zero(&body, joint, -by);
        teach(learner, &moved, hand, 100);
        expect_joint(learner, joint);
        ck_assert_uint_eq(learner_get_body_change(learner).changes, 1);
        ck_assert_double_eq_tol(learner_get_body_change(learner).by[0], -by, 0.1 * by);
        ck_assert_int_eq(experts(learner), 2);
        ck_assert_double_lt(misfit(learner, &moved, stick), 1.5);
        ck_assert_double_lt(misfit(learner, &moved, hand), 1.0);
        /* What is kept is as it would be seen now: learned anew, it says the same. */
        struct body same = *learner_body(learner);
        char err[160];
        ck_assert_int_eq(learner_give_body(learner, &same, err, sizeof err), 0);
        ck_assert_double_lt(misfit(learner, &moved, stick), 1.5);
        ck_assert_double_lt(misfit(learner, &moved, hand), 1.5);
        bed_clean();
    }
}
END_TEST

/* One eye is knocked: the disparity is off by 5 px, and the optical axis by as much. */
START_TEST(a_knock_at_an_eye_is_followed)
{
    bed_seed();
    struct body body = made_up_arm(JOINTS, true);
    struct learner *learner = with_two_tools(&body);
    struct body knocked = body;
    knocked.eyes.disparity_middle += 5.0;
    knocked.eyes.tilt[0] += 0.005;
    knocked.eyes.tilt[1] -= 0.003;
    ck_assert_double_gt(misfit(learner, &knocked, stick), 10.0);
    teach(learner, &knocked, hand, 1000);
    struct learner_body_change change = learner_get_body_change(learner);
    ck_assert_int_eq(change.cause, JOINTS);
    ck_assert_double_eq_tol(change.by[0], 0.005, 0.001);
    ck_assert_double_eq_tol(change.by[1], -0.003, 0.001);
    ck_assert_double_eq_tol(change.by[2], 5.0, 0.5);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_double_lt(misfit(learner, &knocked, stick), 2.0);
    ck_assert_double_lt(misfit(learner, &knocked, hand), 1.0);
    bed_clean();
}
END_TEST

/* For one tool a last joint's zero is a changed tip. The second tool tells them apart. */
START_TEST(a_second_tool_tells_a_last_joint_from_a_slip)
{
    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    const double long_hand[3] = {0.15, 0.1, 0.05}, long_stick[3] = {-0.2, 0.25, 0.1};
    struct learner *learner = on_body(&body, 16);
    struct body moved = with_zero(&body, JOINTS - 1, 2 * degree);
    teach(learner, &body, long_stick, 500);
    teach(learner, &body, long_hand, 500);
    for (int s = 0; s < 6000; s++) {
        struct body now = with_zero(&body, JOINTS - 1, 2 * degree * s / 6000.0);
        teach(learner, &now, long_hand, 1);
    }
    teach(learner, &moved, long_hand, 2000);
    ck_assert_uint_eq(learner_get_body_change(learner).changes, 0);
    ck_assert_double_gt(learner_get_body_change(learner).slip, 1e-3);
    teach(learner, &moved, long_stick, 40);
    expect_joint(learner, JOINTS - 1);
    ck_assert_double_eq_tol(learner_get_body_change(learner).by[0], 2 * degree, 0.2 * degree);
    ck_assert_int_eq(experts(learner), 2);
    ck_assert_double_lt(misfit(learner, &moved, long_stick), 1.5);
    ck_assert_double_lt(misfit(learner, &moved, long_hand), 1.5);
    bed_clean();
}
END_TEST

/* 3 cm in 20,000 samples: told, followed, and nothing else changes. */
START_TEST(a_tool_that_slips_is_told)
{
    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = with_two_tools(&body);
    double tip[3] = {stick[0], stick[1], stick[2]};
    teach(learner, &body, stick, 500);
    for (int s = 0; s < 20000; s++) {
        tip[1] = stick[1] + 0.03 * s / 20000.0;
        teach(learner, &body, tip, 1);
    }
    ck_assert_double_lt(misfit(learner, &body, tip), 5.0); /* it lags by some 1,000 samples */
    teach(learner, &body, tip, 5000);
    ck_assert_double_lt(misfit(learner, &body, tip), 1.0);
    ck_assert_double_lt(misfit(learner, &body, hand), 1.0);
    ck_assert_uint_eq(learner_get_body_change(learner).changes, 0);
    ck_assert_double_gt(learner_get_body_change(learner).slip, 0.01); /* of 3 cm */
    ck_assert_double_lt(learner_get_body_change(learner).slip, 0.033);
    bed_clean();
}
END_TEST

/* Neither a new tool nor a known one that comes back is a change; nor is a gross error. */
START_TEST(a_new_tool_is_no_change)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner *learner = with_two_tools(&body);
        for (int k = 0; k < 8; k++) {
            double tip[3];
            random_tip(tip);
            for (int r = 0; r < 3 && k >= 4; r++) /* nearly the hand */
                tip[r] = hand[r] + 0.1 * tip[r];
            teach(learner, &body, tip, 100);
            teach(learner, &body, k % 2 ? hand : stick, 60);
        }
        struct learner_body_change change = learner_get_body_change(learner);
        ck_assert_uint_eq(change.changes, 0);
        ck_assert_int_eq(change.cause, -1);
        ck_assert_double_eq(change.slip, 0.0);
        ck_assert_double_lt(misfit(learner, &body, hand), 1.0);
        bed_clean();
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        columns_are_what_a_changed_body_shows,
        a_zero_that_moves_slowly_is_followed,
        a_zero_that_jumps_is_followed,
        a_knock_at_an_eye_is_followed,
        a_second_tool_tells_a_last_joint_from_a_slip,
        a_tool_that_slips_is_told,
        a_new_tool_is_no_change,
    };

    return SUITE_RUN("change", tests);
}
