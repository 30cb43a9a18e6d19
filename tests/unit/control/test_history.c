/* Joints between two states. */
#include "daemon/control/senses/joint_history.h"
#include "tests/unit/suite.h"

static struct history filled(int states)
{
    struct history history;

    history_init(&history, 2);
    for (int i = 0; i < states; i++)
        history_push(&history, 1000 + 20 * i, (double[]){i, -2.0 * i});
    return history;
}

START_TEST(between_states_joints_are_linear)
{
    struct history history = filled(10);
    double q[2];

    ck_assert(history_at(&history, 1000 + 50, q));
    ck_assert_double_eq_tol(q[0], 2.5, 1e-12);
    ck_assert_double_eq_tol(q[1], -5, 1e-12);
    ck_assert(history_at(&history, 1000 + 180, q));
    ck_assert_double_eq(q[0], 9);
    ck_assert(history_at(&history, 1000, q));
    ck_assert_double_eq(q[0], 0);
}
END_TEST

START_TEST(what_is_not_held_is_not_guessed)
{
    struct history history = filled(0);
    double q[2] = {7, 7};

    ck_assert(!history_at(&history, 1000, q));
    history = filled(10);
    ck_assert(!history_at(&history, 999, q));
    ck_assert(!history_at(&history, 1000 + 181, q));
    ck_assert_double_eq(q[0], 7);
}
END_TEST

START_TEST(old_states_leave)
{
    struct history history = filled(HISTORY_LENGTH + 10);
    double q[2];

    ck_assert(!history_at(&history, 1000 + 9 * 20, q));
    ck_assert(history_at(&history, 1000 + 10 * 20 + 5, q));
    ck_assert_double_eq_tol(q[0], 10.25, 1e-12);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {between_states_joints_are_linear, what_is_not_held_is_not_guessed,
                                  old_states_leave};

    return SUITE_RUN("history", tests);
}
