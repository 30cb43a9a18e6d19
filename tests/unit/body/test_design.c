/* What an expert is linear in: the slope of its product with theta against differences, and that
 * the sizes are nested. */
#include "learner/body/tool/design.h"

#include <math.h>
#include <string.h>

#include "learner/body/chain/vec3.h"
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

static void product(const struct design *design, const struct body *body, const double *z, int size,
                    const double *theta, double *value)
{
    double rows[3 * DESIGN_MAX];
    struct chain_pose pose;

    chain_at(&body->chain, z, &pose);
    design_rows(design, body, &pose, rows);
    for (int r = 0; r < 3; r++) {
        value[r] = 0.0;
        for (int k = 0; k < size; k++)
            value[r] += rows[r * design->size[2] + k] * theta[k];
    }
}

START_TEST(the_slope_is_that_of_the_rows)
{
    const double step = 1e-6;

    bed_seed();
    for (int n = 1; n <= CHAIN_MAX_JOINTS; n++)
        for (int k = 0; k < DESIGN_SIZES; k++) {
            struct body body = made_up_arm(n, false);
            struct design design;
            struct chain_pose pose;
            double theta[DESIGN_MAX], z[CHAIN_MAX_JOINTS], slope[3 * CHAIN_MAX_JOINTS];
            body.chain.slides[n / 2] = n % 3 == 0;
            random_unit(body.gravity);
            design_init(&design, &body);
            for (int i = 0; i < DESIGN_MAX; i++)
                theta[i] = bed_normal();
            random_joints(&body, z);
            chain_at(&body.chain, z, &pose);
            design_slope(&design, &body, &pose, design.size[k], theta, slope);
            for (int i = 0; i < n; i++) {
                double here = z[i];
                double behind[3], ahead[3];
                z[i] = here - step;
                product(&design, &body, z, design.size[k], theta, behind);
                z[i] = here + step;
                product(&design, &body, z, design.size[k], theta, ahead);
                z[i] = here;
                for (int r = 0; r < 3; r++)
                    ck_assert_double_eq_tol(slope[r * n + i], (ahead[r] - behind[r]) / (2.0 * step),
                                            1e-8);
            }
        }
}
END_TEST

START_TEST(a_tip_is_where_the_frame_has_it)
{
    bed_seed();
    struct body body = made_up_arm(5, false);
    struct design design;
    struct chain_pose pose;
    double theta[DESIGN_MAX] = {0};
    double z[CHAIN_MAX_JOINTS], tip[3], turned[3], value[3], felt[3], given[3];

    design_init(&design, &body);
    for (int k = 0; k < 3; k++) {
        tip[k] = 0.2 * bed_normal();
        theta[k] = tip[k] / design.sd_tip;
    }
    random_joints(&body, z);
    chain_at(&body.chain, z, &pose);
    mat3_apply(pose.turn[5], tip, turned);
    product(&design, &body, z, DESIGN_TIP, theta, value);
    for (int r = 0; r < 3; r++)
        ck_assert_double_eq_tol(value[r], turned[r], 1e-14);

    double A[9]; /* a droop besides: R (o + A R' g) */
    for (int k = 0; k < 9; k++) {
        A[k] = 0.05 * bed_normal();
        theta[DESIGN_TIP + k] = A[k] / design.sd_droop;
    }
    mat3_apply_transposed(pose.turn[5], body.gravity, felt);
    mat3_apply(A, felt, given);
    vec3_add(1.0, tip, given);
    mat3_apply(pose.turn[5], given, turned);
    product(&design, &body, z, DESIGN_TIP + DESIGN_DROOP, theta, value);
    for (int r = 0; r < 3; r++)
        ck_assert_double_eq_tol(value[r], turned[r], 1e-14);
}
END_TEST

START_TEST(sizes_fit_into_a_tick)
{
    for (int n = 1; n <= CHAIN_MAX_JOINTS; n++) {
        struct body body = made_up_arm(n, false);
        struct design design;
        design_init(&design, &body);
        ck_assert_int_eq(design.size[0], 3);
        ck_assert_int_eq(design.size[1], 12);
        ck_assert_int_gt(design.size[2], design.size[1]);
        ck_assert_int_le(design.size[2], DESIGN_MAX);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        the_slope_is_that_of_the_rows,
        a_tip_is_where_the_frame_has_it,
        sizes_fit_into_a_tick,
    };

    return SUITE_RUN("design", tests);
}
