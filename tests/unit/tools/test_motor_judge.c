/* What is said of a joint from what was commanded and measured: synthetic moves of two degrees. */
#include "tests/unit/suite.h"
#include "tools/reachctl/motors/judge.h"

#include <math.h>

static const double period = 0.02;
static const double speed = 0.05;   /* rad/s */
static const double stamp = 0.004;  /* a measurement is older than the command by, s */
static const double start_at = 100; /* s */
enum { MOVING = 35, MOVE = 55 };    /* ticks of a move, and with its rest */

/* A joint that moves as described. */
struct joint {
    double scale, delay, backlash;
};

static struct motor_row rows[2000];
static size_t n_rows;

/* 0.7 s of motion and 0.4 s of rest for each direction. */
static double velocity_at(int tick, const double *directions, int moves)
{
    return tick >= 0 && tick / MOVE < moves && tick % MOVE < MOVING
               ? directions[tick / MOVE] * speed
               : 0;
}

/* What was commanded up to a time after the start, rad. */
static double path_at(double time, const double *directions, int moves)
{
    double sum = 0;

    for (int tick = 0; tick < moves * MOVE && tick * period < time; tick++)
        sum += velocity_at(tick, directions, moves) * fmin(period, time - tick * period);
    return sum;
}

static struct motor_report judge(struct joint joint, const double *directions, int moves)
{
    double shaft = 0; /* behind the backlash */

    n_rows = 0;
    for (int tick = -5; tick < moves * MOVE; tick++) {
        double at = tick * period;
        double drive = joint.scale * path_at(at - stamp - joint.delay, directions, moves);
        shaft = fmax(fmin(shaft, drive + joint.backlash / 2), drive - joint.backlash / 2);
        rows[n_rows++] = (struct motor_row){start_at + at, velocity_at(tick, directions, moves),
                                            start_at + at - stamp, 0.3 + shaft};
    }
    return motor_judge(rows, n_rows);
}

static const double to_and_fro[] = {1, 1, -1, -1};

START_TEST(a_good_joint_is_well)
{
    for (int side = 0; side < 2; side++) {
        const double turned[] = {-1, -1, 1, 1};
        struct motor_report report =
            judge((struct joint){1, 0.045, 0}, side ? turned : to_and_fro, 4);
        ck_assert_int_eq(report.verdict, MOTOR_WELL);
        ck_assert_double_eq_tol(report.scale, 1, 1e-9);
        ck_assert_double_eq_tol(report.delay, 0.045, 1e-4);
        ck_assert_double_eq_tol(report.backlash, 0, 1e-9);
    }
}
END_TEST

START_TEST(sign_and_scale)
{
    struct motor_report report = judge((struct joint){-1, 0.02, 0}, to_and_fro, 4);

    ck_assert_int_eq(report.verdict, MOTOR_REVERSED);
    ck_assert_double_eq_tol(report.scale, -1, 1e-9);
    ck_assert_double_eq_tol(report.delay, 0.02, 1e-4);
    report = judge((struct joint){0.8, 0.02, 0}, to_and_fro, 4);
    ck_assert_int_eq(report.verdict, MOTOR_SCALE);
    ck_assert_double_eq_tol(report.scale, 0.8, 1e-9);
    report = judge((struct joint){1.04, 0.02, 0}, to_and_fro, 4);
    ck_assert_int_eq(report.verdict, MOTOR_WELL);
    report = judge((struct joint){0, 0, 0}, to_and_fro, 4);
    ck_assert_int_eq(report.verdict, MOTOR_STILL);
    ck_assert(isnan(report.scale) && isnan(report.delay) && isnan(report.backlash));
}
END_TEST

START_TEST(backlash_is_no_scale)
{
    struct motor_report report = judge((struct joint){0.98, 0.06, 0.01}, to_and_fro, 4);

    ck_assert_int_eq(report.verdict, MOTOR_WELL);
    ck_assert_double_eq_tol(report.scale, 0.98, 1e-9);
    ck_assert_double_eq_tol(report.backlash, 0.01, 1e-9);
    ck_assert_double_eq_tol(report.delay, 0.06, 1e-4);
}
END_TEST

/* Stopped within the work: what was heard until then is judged. */
START_TEST(what_was_cut_short)
{
    struct motor_report report = judge((struct joint){-1, 0, 0}, to_and_fro, 1);

    ck_assert_int_eq(report.verdict, MOTOR_REVERSED);
    ck_assert(isnan(report.scale));
    report = judge((struct joint){1, 0, 0}, to_and_fro, 0);
    ck_assert_int_eq(report.verdict, MOTOR_UNSEEN);
    ck_assert_int_eq(motor_judge(rows, 0).verdict, MOTOR_UNSEEN);
    judge((struct joint){1, 0, 0}, to_and_fro, 4);
    ck_assert_int_eq(motor_judge(rows, 20).verdict, MOTOR_UNSEEN); /* in its first move */
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_good_joint_is_well, sign_and_scale, backlash_is_no_scale,
                                  what_was_cut_short};

    return SUITE_RUN("motor_judge", tests);
}
