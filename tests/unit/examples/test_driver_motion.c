/* What an arm's drives are given, whatever is commanded: the core of the examples' drivers. */
#include "examples/motion/motion.h"
#include "tests/unit/seed.h"
#include "tests/unit/suite.h"

#include <math.h>

enum { JOINTS = 2 };

static const double lowest[] = {-1, -2}, highest[] = {1, 2}, fastest[] = {1, 2},
                    acceleration[] = {4, 8};
static const double leash = 0.2, period = 0.005;

/* An arm that follows its set-point with a lag, or is held. */
struct arm {
    struct motion *motion;
    double q[JOINTS], set_point[JOINTS], velocity[JOINTS];
    double lag; /* s; of no time at all when 0 */
    bool held;
    int64_t now;
};

static struct arm begin(double q0, double q1)
{
    struct arm arm = {.q = {q0, q1}, .now = 1000000};

    arm.motion = motion_create(JOINTS, lowest, highest, fastest, acceleration, leash, period);
    ck_assert_ptr_nonnull(arm.motion);
    return arm;
}

static void step(struct arm *arm, int64_t passed)
{
    arm->now += passed;
    ck_assert(motion_step(arm->motion, arm->q, NULL, NULL, arm->now, arm->now, arm->set_point,
                          arm->velocity));
    for (int i = 0; i < JOINTS && !arm->held; i++)
        arm->q[i] += (arm->set_point[i] - arm->q[i]) *
                     (arm->lag > 0 ? 1 - exp(-(double)passed * 1e-6 / arm->lag) : 1);
}

/* So many periods, in which a command comes every 20 ms. */
static void run(struct arm *arm, int periods, int64_t each, const double *command)
{
    for (int i = 0; i < periods; i++) {
        if (command && (int64_t)i * each % 20000 < each)
            ck_assert(motion_command(arm->motion, JOINTS, command, arm->now));
        step(arm, each);
    }
}

START_TEST(it_begins_where_the_arm_is_and_holds)
{
    struct arm arm = begin(0.7, -1.5);

    run(&arm, 1000, 1000, NULL);
    ck_assert_double_eq(arm.set_point[0], 0.7);
    ck_assert_double_eq(arm.set_point[1], -1.5);
    ck_assert_double_eq(arm.velocity[0], 0);
    motion_destroy(arm.motion);
}
END_TEST

/* Random commands, absurd ones among them, at several rates. */
START_TEST(whatever_comes_velocity_acceleration_and_range_hold)
{
    const int64_t periods[] = {5000, 1000};

    for (size_t k = 0; k < 2; k++) {
        struct arm arm = begin(0, 0);
        double dt = (double)periods[k] * 1e-6, before[JOINTS] = {0};
        struct random_state random = fixture_random("whatever comes");

        arm.lag = 0.03;
        for (int i = 0; i < 20000; i++) {
            double command[JOINTS] = {random_uniform(&random, -10, 10),
                                      random_uniform(&random, -6, 14)};
            if (random_uniform(&random, 0, 1) < 0.1)
                ck_assert(motion_command(arm.motion, JOINTS, command, arm.now));
            step(&arm, periods[k]);
            for (int j = 0; j < JOINTS; j++) {
                ck_assert_double_le(fabs(arm.velocity[j]), fastest[j] + 1e-9);
                ck_assert_double_le(fabs(arm.velocity[j] - before[j]), acceleration[j] * dt + 1e-9);
                ck_assert_double_le(arm.set_point[j], highest[j] + 1e-9);
                ck_assert_double_ge(arm.set_point[j], lowest[j] - 1e-9);
                before[j] = arm.velocity[j];
            }
        }
        motion_destroy(arm.motion);
    }
}
END_TEST

START_TEST(a_command_is_obeyed_to_the_ends_of_the_range)
{
    struct arm arm = begin(0, 0);

    arm.lag = 0.03;
    run(&arm, 500, 1000, (double[]){0.5, -0.5});
    ck_assert_double_eq_tol(arm.velocity[0], 0.5, 1e-9);
    ck_assert_double_eq_tol(arm.velocity[1], -0.5, 1e-9);
    run(&arm, 10000, 1000, (double[]){0.5, -0.5});
    ck_assert_double_eq_tol(arm.q[0], 1, 1e-3);
    ck_assert_double_eq_tol(arm.q[1], -2, 1e-3);
    run(&arm, 500, 1000, (double[]){-0.5, 0.5});
    ck_assert_double_lt(arm.q[0], 0.9);
    motion_destroy(arm.motion);
}
END_TEST

/* Its joint is held by something: the set-point does not run away, nor does the arm leap after. */
START_TEST(the_set_point_stays_on_the_leash)
{
    struct arm arm = begin(0, 0);

    arm.held = true;
    run(&arm, 3000, 1000, (double[]){0.5, 0});
    ck_assert_double_le(arm.set_point[0], leash + 1e-6);
    ck_assert_double_gt(arm.set_point[0], 0.9 * leash);
    ck_assert_int_eq(motion_leashed(arm.motion), 1);
    arm.held = false;
    arm.lag = 0.03;
    run(&arm, 1000, 1000, (double[]){0.5, 0});
    ck_assert_double_gt(arm.q[0], 0.5);
    ck_assert_int_eq(motion_leashed(arm.motion), 0);
    motion_destroy(arm.motion);
}
END_TEST

/* A lag that is no fault, at a speed from which it takes more than the leash to brake: it holds
 * back nothing. */
START_TEST(an_arm_that_follows_is_not_held_back)
{
    struct arm arm = begin(0, -1.9);

    arm.lag = 0.06;
    run(&arm, 600, 1000, (double[]){0, 2});
    ck_assert_double_eq_tol(arm.velocity[1], 2, 1e-9);
    ck_assert_int_eq(motion_leashed(arm.motion), 0);
    arm.held = true; /* at once */
    run(&arm, 600, 1000, (double[]){0, 2});
    ck_assert_double_eq_tol(arm.velocity[1], 0, 1e-9);
    ck_assert_double_le(arm.set_point[1] - arm.q[1], leash + 2 * 2 / (2 * acceleration[1]));
    motion_destroy(arm.motion);
}
END_TEST

/* It sags, or somebody pushes it: no way to command. */
START_TEST(an_arm_that_is_pushed_does_not_take_the_set_point_along)
{
    struct arm arm = begin(0, 0);

    arm.held = true;
    step(&arm, 1000);
    for (int i = 0; i < 1000; i++) {
        arm.q[0] -= 0.5e-3;
        step(&arm, 1000);
    }
    ck_assert_double_eq(arm.set_point[0], 0);
    motion_destroy(arm.motion);
}
END_TEST

START_TEST(a_stale_command_is_none_by_either_clock)
{
    const double command[] = {0.5, 0.5};
    double position[JOINTS], velocity[JOINTS];
    struct arm arm = begin(0, 0);

    run(&arm, 300, 1000, command);
    run(&arm, MOTION_FRESH_US / 1000 + 200, 1000, NULL);
    ck_assert_double_eq(arm.velocity[0], 0);
    /* our clock stands nearly still, the robot's does not */
    for (int i = 0; i < 300; i++) {
        if (i == 0)
            ck_assert(motion_command(arm.motion, JOINTS, command, arm.now));
        ck_assert(motion_step(arm.motion, arm.q, NULL, NULL, arm.now + (int64_t)i * 1000,
                              arm.now + i, position, velocity));
        if (i == 90)
            ck_assert_double_gt(velocity[0], 0.3);
    }
    ck_assert_double_eq(velocity[0], 0);
    motion_destroy(arm.motion);
}
END_TEST

START_TEST(what_is_no_command_changes_nothing)
{
    struct arm arm = begin(0, 0);

    ck_assert(!motion_command(arm.motion, JOINTS, (double[]){NAN, 0.1}, arm.now));
    ck_assert(!motion_command(arm.motion, JOINTS, (double[]){0.1, INFINITY}, arm.now));
    ck_assert(!motion_command(arm.motion, 1, (double[]){0.1}, arm.now));
    run(&arm, 50, 1000, NULL);
    ck_assert_double_eq(arm.set_point[0], 0);
    ck_assert(!motion_step(arm.motion, (double[]){NAN, 0}, NULL, NULL, arm.now, arm.now,
                           arm.set_point, arm.velocity));
    motion_destroy(arm.motion);
}
END_TEST

/* The robot was switched off, its simulator begun anew, or readings were lost. */
START_TEST(after_a_gap_it_begins_where_the_arm_is)
{
    const int64_t jumps[] = {MOTION_GAP_US + 1000, -500000};

    for (size_t i = 0; i < 2; i++) {
        struct arm arm = begin(0, 0);
        run(&arm, 400, 1000, (double[]){0.5, 0});
        arm.q[0] = -0.8;
        step(&arm, jumps[i]);
        ck_assert_double_eq(arm.set_point[0], -0.8);
        ck_assert_double_eq(arm.velocity[0], 0);
        motion_destroy(arm.motion);
    }
}
END_TEST

/* Readings were lost: the drives are not sent after what they missed. */
START_TEST(lost_readings_are_no_leap)
{
    struct arm arm = begin(0, 0);
    double before;

    run(&arm, 400, 1000, (double[]){1, 0});
    before = arm.set_point[0];
    step(&arm, 60000);
    ck_assert_double_le(arm.set_point[0] - before, 1 * period + 1e-9);
    ck_assert_double_gt(arm.set_point[0], before);
    motion_destroy(arm.motion);
}
END_TEST

/* Drives that are given velocities integrate by themselves: what they say counts. */
START_TEST(the_drives_own_set_point_counts)
{
    struct motion *motion =
        motion_create(JOINTS, lowest, highest, fastest, acceleration, leash, period);
    double q[JOINTS] = {0.9, 0}, dq[JOINTS] = {0}, position[JOINTS], velocity[JOINTS];
    int64_t now = 1000000;

    for (int i = 0; i < 5000; i++, now += 1000) {
        ck_assert(motion_command(motion, JOINTS, (double[]){1, 0}, now));
        ck_assert(motion_step(motion, q, q, dq, now, now, position, velocity));
        ck_assert_double_le(fabs(velocity[0] - dq[0]), acceleration[0] * 1e-3 + 1e-9);
        for (int j = 0; j < JOINTS; j++) {
            dq[j] = velocity[j];
            q[j] += 1.1 * dq[j] * 1e-3; /* ten per cent more than they say */
        }
        ck_assert_double_le(q[0], highest[0] + 5e-3);
    }
    ck_assert_double_ge(q[0], highest[0] - 1e-2);
    motion_destroy(motion);
}
END_TEST

START_TEST(limits_that_are_none_are_refused)
{
    const double nan2[] = {NAN, 1}, zero[] = {0, 1};

    ck_assert_ptr_null(motion_create(0, lowest, highest, fastest, acceleration, leash, period));
    ck_assert_ptr_null(
        motion_create(MOTION_JOINTS + 1, lowest, highest, fastest, acceleration, leash, period));
    ck_assert_ptr_null(
        motion_create(JOINTS, highest, lowest, fastest, acceleration, leash, period));
    ck_assert_ptr_null(motion_create(JOINTS, lowest, highest, zero, acceleration, leash, period));
    ck_assert_ptr_null(motion_create(JOINTS, lowest, highest, fastest, nan2, leash, period));
    ck_assert_ptr_null(motion_create(JOINTS, lowest, highest, fastest, acceleration, 0, period));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        it_begins_where_the_arm_is_and_holds,
        whatever_comes_velocity_acceleration_and_range_hold,
        a_command_is_obeyed_to_the_ends_of_the_range,
        the_set_point_stays_on_the_leash,
        an_arm_that_follows_is_not_held_back,
        an_arm_that_is_pushed_does_not_take_the_set_point_along,
        a_stale_command_is_none_by_either_clock,
        what_is_no_command_changes_nothing,
        after_a_gap_it_begins_where_the_arm_is,
        lost_readings_are_no_leap,
        the_drives_own_set_point_counts,
        limits_that_are_none_are_refused,
    };

    return SUITE_RUN("motion", tests);
}
