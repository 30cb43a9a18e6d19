/* Running statistics. */
#include "common/base/duration_histogram.h"
#include "tests/unit/suite.h"

START_TEST(quantiles_are_within_a_bucket)
{
    static struct duration_histogram durations;

    for (int i = 1; i <= 10000; i++)
        duration_histogram_add(&durations, i);
    ck_assert_double_eq(durations.last, 10000);
    ck_assert_double_eq(durations.max, 10000);
    ck_assert_double_eq_tol(duration_histogram_mean(&durations), 5000.5, 1e-9);
    ck_assert_double_eq_tol(duration_histogram_quantile(&durations, 0.5), 5000, 300);
    ck_assert_double_eq_tol(duration_histogram_quantile(&durations, 0.999), 9990, 11);
    ck_assert_double_le(duration_histogram_quantile(&durations, 1), 10000);
}
END_TEST

START_TEST(nothing_measured_is_zero)
{
    static struct duration_histogram durations;

    ck_assert_double_eq(duration_histogram_mean(&durations), 0);
    ck_assert_double_eq(duration_histogram_quantile(&durations, 0.999), 0);
    duration_histogram_add(&durations, 0);
    duration_histogram_add(&durations, 1e30);
    ck_assert_double_eq(durations.max, 1e30);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {quantiles_are_within_a_bucket, nothing_measured_is_zero};

    return SUITE_RUN("duration_histogram", tests);
}
