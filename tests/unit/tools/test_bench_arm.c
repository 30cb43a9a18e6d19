/* The arm that the benches learn: its kinematics against products of rotation matrices, and its
 * stream. */
#include "tools/bench/arm.h"

#include <math.h>
#include <string.h>

#include "tests/unit/suite.h"

/* v = R(angle about x, y or z) v, by the matrix. */
static void rotate(char axis, double angle, double v[3])
{
    double c = cos(angle);
    double s = sin(angle);
    const double matrices[3][3][3] = {
        {{1, 0, 0}, {0, c, -s}, {0, s, c}},
        {{c, 0, s}, {0, 1, 0}, {-s, 0, c}},
        {{c, -s, 0}, {s, c, 0}, {0, 0, 1}},
    };
    double result[3] = {0};

    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            result[i] += matrices[axis - 'x'][i][k] * v[k];
    memcpy(v, result, sizeof result);
}

static void add(double v[3], double x, double y, double z)
{
    v[0] += x;
    v[1] += y;
    v[2] += z;
}

/* Rz(q1) Rx(q2) Ry(q3) [shoulder + Ry(q4) Rx(-q5) [elbow + Rz(-q6) Ry(-q7) [palm + tool]]] */
static void reference_tip(const double q[7], const double tool[3], double v[3])
{
    memcpy(v, tool, 3 * sizeof *v);
    add(v, 0, 0, -0.197);
    rotate('y', -q[6], v);
    rotate('z', -q[5], v);
    add(v, 0, 0, -0.152);
    rotate('x', -q[4], v);
    rotate('y', q[3], v);
    add(v, 0, -0.11, 0.18);
    rotate('y', q[2], v);
    rotate('x', q[1], v);
    rotate('z', q[0], v);
}

START_TEST(tip_is_the_product_of_rotations)
{
    struct arm_stream stream = arm_stream_start(3, 7, 0.3);
    double q[7];
    double x[3];
    double wanted[3];

    for (int n = 0; n < 200; n++) {
        arm_stream_take_tool(&stream, n % 5);
        arm_stream_query(&stream, q);
        arm_tip(q, stream.tool, x);
        reference_tip(q, stream.tool, wanted);
        for (int i = 0; i < 3; i++)
            ck_assert_double_eq_tol(x[i], wanted[i], 1e-14);
    }
}
END_TEST

START_TEST(tools_differ_and_number_0_is_none)
{
    struct arm_stream stream = arm_stream_start(3, 7, 0.3);
    double first[3];

    arm_stream_take_tool(&stream, 1);
    memcpy(first, stream.tool, sizeof first);
    ck_assert_double_gt(fabs(first[0]) + fabs(first[1]) + fabs(first[2]), 0);
    arm_stream_take_tool(&stream, 2);
    ck_assert_int_ne(memcmp(first, stream.tool, sizeof first), 0);
    arm_stream_take_tool(&stream, 1);
    ck_assert_int_eq(memcmp(first, stream.tool, sizeof first), 0);
    arm_stream_take_tool(&stream, 0);
    for (int i = 0; i < 3; i++)
        ck_assert_double_eq(stream.tool[i], 0);
}
END_TEST

/* Never faster than asked, with measurements near the truth; four inputs leave the waist at zero.
 */
START_TEST(walk_is_smooth_and_measured)
{
    struct arm_stream stream = arm_stream_start(5, 4, 0.1);
    double before[4];
    double z[4];
    double x[3];
    double truth[3];
    double moved = 0;

    arm_stream_next(&stream, before, x);
    for (int n = 0; n < 1000; n++) {
        double q[7] = {0};
        arm_stream_next(&stream, z, x);
        for (int i = 0; i < 4; i++) {
            ck_assert_double_le(fabs(z[i] - before[i]), 0.1 + 1e-12);
            moved += fabs(z[i] - before[i]);
        }
        memcpy(q + 3, z, sizeof z);
        arm_tip(q, stream.tool, truth);
        for (int i = 0; i < 3; i++)
            ck_assert_double_le(fabs(x[i] - truth[i]), 0.004);
        memcpy(before, z, sizeof z);
    }
    ck_assert_double_gt(moved, 50);
}
END_TEST

/* The body that the benches give to a learner is this arm. */
START_TEST(body_is_the_arm)
{
    struct arm_stream stream = arm_stream_start(6, 7, 0.1);
    struct body body = arm_body();
    char err[160];

    ck_assert_msg(body_check(&body, err, sizeof err) == 0, "%s", err);
    for (int n = 0; n < 100; n++) {
        struct chain_pose pose;
        double q[7];
        double truth[3];
        arm_stream_take_tool(&stream, n % 3);
        arm_stream_query(&stream, q);
        arm_tip(q, stream.tool, truth);
        chain_at(&body.chain, q, &pose);
        for (int r = 0; r < 3; r++) {
            double at = pose.p[r];
            for (int k = 0; k < 3; k++)
                at += pose.turn[7][3 * r + k] * (stream.tool[k] - (k == 2 ? 0.197 : 0.0));
            ck_assert_double_eq_tol(at, truth[r], 1e-12);
        }
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {tip_is_the_product_of_rotations,
                                  tools_differ_and_number_0_is_none, walk_is_smooth_and_measured,
                                  body_is_the_arm};
    return SUITE_RUN("arm of the benches", tests);
}
