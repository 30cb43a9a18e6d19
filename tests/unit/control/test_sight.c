/* What the eyes told: fixation, carrying to now, training pairs that belong to one instant. */
#include "daemon/control/senses/sight.h"
#include "fixture.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <string.h>

static struct config config;
static struct sight sight;
static struct history history;

/* Joints move at a constant speed: joint i is at i + 0.1 t. */
static void begin(double speed)
{
    double q[MAX_JOINTS];

    config = fixture_config(NULL, 0);
    sight_init(&sight, &config);
    history_init(&history, 6);
    for (int k = 0; k <= 50; k++) {
        for (int i = 0; i < 6; i++)
            q[i] = i + speed * 0.02 * k;
        history_push(&history, 1000000 + 20000 * k, q);
    }
}

static bool see(int64_t utime, double u, double v, double disparity)
{
    struct observation marker = {
        .utime = utime, .seen = 1, .value[0] = u, .value[1] = v, .value[2] = disparity};

    return sight_observe(&sight, &marker, &history);
}

START_TEST(a_pair_has_the_joints_of_the_exposure)
{
    double q[MAX_JOINTS], x[MAX_OUTPUTS];
    int64_t utime;

    begin(0.1);
    ck_assert(see(1033000, 0, 0, 5));
    sight_pair(&sight, 1, q, x, &utime);
    ck_assert_int_eq(utime, 1033000);
    for (int i = 0; i < 4; i++)
        ck_assert_double_eq_tol(q[i], i + 0.1 * 0.033, 1e-12);
    ck_assert_double_eq_tol(x[0], 4 + 0.0033, 1e-12);
    ck_assert_double_eq_tol(x[1], 5 + 0.0033, 1e-12);
    ck_assert_double_eq(x[2], 5);
}
END_TEST

START_TEST(what_is_left_of_the_error_is_added)
{
    double q[MAX_JOINTS], x[MAX_OUTPUTS];
    int64_t utime;

    begin(0);
    see(1033000, 1.2, 0, 5);
    see(1066000, 0, -2.4, 7);
    sight_pair(&sight, 2, q, x, &utime);
    ck_assert_int_eq(utime, 1049500);
    ck_assert_double_eq_tol(x[0], 4 - 0.6 / 1200, 1e-12);
    ck_assert_double_eq_tol(x[1], 5 - 1.2 / 1200, 1e-12);
    ck_assert_double_eq_tol(x[2], 6, 1e-12);
}
END_TEST

START_TEST(fixation_needs_rest_and_centre)
{
    begin(0);
    for (int k = 1; k <= config.fixation_frames; k++) {
        ck_assert(!sight_fixated(&sight));
        see(1000000 + 33000 * k, 0.5, -0.5, 10);
    }
    ck_assert(sight_fixated(&sight));
    begin(0);
    for (int k = 1; k <= config.fixation_frames; k++)
        see(1000000 + 33000 * k, config.fixation_tolerance + 0.5, 0, 10);
    ck_assert(!sight_fixated(&sight)); /* off the centre */
    begin(0);
    for (int k = 1; k <= config.fixation_frames; k++)
        see(1000000 + 33000 * k, 0, 0, 10 + k * config.fixation_rest);
    ck_assert(!sight_fixated(&sight)); /* swings in depth */
    begin(0.1);
    for (int k = 1; k <= config.fixation_frames; k++)
        see(1000000 + 33000 * k, 0, 0, 10);
    ck_assert(!sight_fixated(&sight)); /* the joints move */
}
END_TEST

START_TEST(a_frame_without_marker_breaks_the_row)
{
    struct observation hidden = {.utime = 1000000 + 33000 * 20};

    begin(0);
    for (int k = 1; k <= config.fixation_frames; k++)
        see(1000000 + 33000 * k, 0, 0, 10);
    ck_assert(sight_observe(&sight, &hidden, &history));
    ck_assert(!sight_fixated(&sight));
    ck_assert(!sight_seen(&sight, hidden.utime));
}
END_TEST

START_TEST(repeats_and_the_unknown_past_are_ignored)
{
    begin(0);
    ck_assert(see(1033000, 1, 1, 1));
    ck_assert(!see(1033000, 9, 9, 9));
    ck_assert(!see(1000500, 9, 9, 9));
    ck_assert(!see(900000, 9, 9, 9));
    ck_assert(!see(99000000, 9, 9, 9)); /* the future */
    ck_assert(sight_seen(&sight, 1100000));
    ck_assert(!sight_seen(&sight, 1033000 + (int64_t)(config.eyes_stale * 1e6) + 1));
}
END_TEST

START_TEST(the_marker_is_carried_by_head_and_arm)
{
    double q[MAX_JOINTS], jacobian[3 * 4] = {0};

    begin(0);
    see(1033000, 10, 20, 30);
    for (int i = 0; i < 6; i++)
        q[i] = i;
    q[4] += 0.01; /* the head turns left: the image moves right */
    sight_carry(&sight, q, NULL);
    ck_assert_double_eq_tol(sight.carried[0], 10 + 12, 1e-9);
    ck_assert_double_eq_tol(sight.carried[1], 20, 1e-9);
    q[4] -= 0.01;
    q[5] += 0.01; /* the head looks down: the image moves up */
    sight_carry(&sight, q, NULL);
    ck_assert_double_eq_tol(sight.carried[1], 20 - 12, 1e-9);
    q[5] -= 0.01;
    q[2] += 0.5;
    jacobian[2] = 0.02; /* the arm takes the marker to the left */
    jacobian[2 * 4 + 2] = 6;
    sight_carry(&sight, q, jacobian);
    ck_assert_double_eq_tol(sight.carried[0], 10 - 12, 1e-9);
    ck_assert_double_eq_tol(sight.carried[2], 33, 1e-9);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_pair_has_the_joints_of_the_exposure,    what_is_left_of_the_error_is_added,
        fixation_needs_rest_and_centre,           a_frame_without_marker_breaks_the_row,
        repeats_and_the_unknown_past_are_ignored, the_marker_is_carried_by_head_and_arm};

    return SUITE_RUN("sight", tests);
}
