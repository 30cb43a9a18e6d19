/* Times and their quantiles. */
#include "tools/measure/durations.h"

#include <math.h>

#include "tests/unit/suite.h"

START_TEST(quantiles_are_ranks)
{
    double us[1000];
    struct durations durations = {.n = 1000, .room = 1000, .us = us};

    for (int i = 0; i < 1000; i++)
        us[i] = (i * 377) % 1000 + 1; /* 1 .. 1000 in another order */
    struct durations_summary summary = durations_summarise(&durations);
    ck_assert_uint_eq(summary.n, 1000);
    ck_assert_double_eq_tol(summary.mean, 500.5, 1e-9);
    ck_assert_double_eq(summary.p50, 500);
    ck_assert_double_eq(summary.p99, 990);
    ck_assert_double_eq(summary.p999, 999);
    ck_assert_double_eq(summary.max, 1000);
}
END_TEST

START_TEST(few_or_none)
{
    double us[1] = {7};
    struct durations durations = {.n = 1, .room = 1, .us = us};
    struct durations_summary summary = durations_summarise(&durations);

    ck_assert_double_eq(summary.p50, 7);
    ck_assert_double_eq(summary.p999, 7);
    durations_clear(&durations);
    summary = durations_summarise(&durations);
    ck_assert_uint_eq(summary.n, 0);
    ck_assert(isnan(summary.mean) && isnan(summary.p50) && isnan(summary.max));
}
END_TEST

/* The clock of the thread advances with its work, and only as much as wall time could. */
START_TEST(work_takes_time)
{
    struct durations durations = {0};
    volatile double sum = 0;

    for (int n = 0; n < 5000; n++) {
        int64_t start = durations_clock();
        for (int i = 0; i < 1000; i++)
            sum = sum + sqrt(i);
        durations_add(&durations, start);
    }
    ck_assert_uint_eq(durations.n, 5000);
    struct durations_summary summary = durations_summarise(&durations);
    ck_assert(summary.p50 > 0.1 && summary.p50 < 10000);
    durations_free(&durations);
    ck_assert_uint_eq(durations.n, 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {quantiles_are_ranks, few_or_none, work_takes_time};
    return SUITE_RUN("durations", tests);
}
