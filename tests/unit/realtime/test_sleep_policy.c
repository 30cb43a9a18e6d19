/* The sleep policy: on the grid, whole periods skipped and counted. */
#include "daemon/realtime/sleep_policy.h"
#include "tests/unit/suite.h"

START_TEST(on_time_means_the_next_period)
{
    int64_t skipped;

    ck_assert_int_eq(sleep_policy_next(1000, 1000, 20, &skipped), 1020);
    ck_assert_int_eq(skipped, 0);
    ck_assert_int_eq(sleep_policy_next(1000, 1020, 20, &skipped), 1020);
    ck_assert_int_eq(skipped, 0);
}
END_TEST

START_TEST(a_late_loop_stays_on_the_grid)
{
    int64_t skipped;

    ck_assert_int_eq(sleep_policy_next(1000, 1021, 20, &skipped), 1040);
    ck_assert_int_eq(skipped, 1);
    ck_assert_int_eq(sleep_policy_next(1000, 1095, 20, &skipped), 1100);
    ck_assert_int_eq(skipped, 4);
    for (int64_t late = 0; late < 500; late++) {
        int64_t next = sleep_policy_next(1000, 1000 + late, 20, &skipped);
        ck_assert_int_eq((next - 1000) % 20, 0);
        ck_assert_int_ge(next, 1000 + late);
        ck_assert_int_eq(next, 1020 + 20 * skipped);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {on_time_means_the_next_period, a_late_loop_stays_on_the_grid};

    return SUITE_RUN("sleep_policy", tests);
}
