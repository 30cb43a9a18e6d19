/* Running statistics. */
#include "common/base/duration_histogram.h"
#include "tests/unit/suite.h"

START_TEST(quantiles_are_within_a_bucket)
{
    static struct timing timing;

    for (int i = 1; i <= 10000; i++)
        timing_add(&timing, i);
    ck_assert_double_eq(timing.last, 10000);
    ck_assert_double_eq(timing.max, 10000);
    ck_assert_double_eq_tol(timing_mean(&timing), 5000.5, 1e-9);
    ck_assert_double_eq_tol(timing_quantile(&timing, 0.5), 5000, 300);
    ck_assert_double_eq_tol(timing_quantile(&timing, 0.999), 9990, 11);
    ck_assert_double_le(timing_quantile(&timing, 1), 10000);
}
END_TEST

START_TEST(nothing_measured_is_zero)
{
    static struct timing timing;

    ck_assert_double_eq(timing_mean(&timing), 0);
    ck_assert_double_eq(timing_quantile(&timing, 0.999), 0);
    timing_add(&timing, 0);
    timing_add(&timing, 1e30);
    ck_assert_double_eq(timing.max, 1e30);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {quantiles_are_within_a_bucket, nothing_measured_is_zero};

    return SUITE_RUN("timing", tests);
}
