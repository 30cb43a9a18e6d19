/* Our exp, log and gamma functions against the C library's in long double. */
#include "common/base/elementary.h"

#include <check.h>
#include <stdio.h>

#include "bed.h"
#include "tests/unit/suite.h"

enum { POINTS = 400000 };

/* Distance of a double from the exact value, in units of its last place there. */
static double ulps(double ours, long double exact)
{
    int exponent = 0;

    if ((double)exact == 0.0)
        return ours == 0.0 ? 0.0 : INFINITY;
    (void)frexp((double)exact, &exponent);
    return (double)(fabsl((long double)ours - exact) / ldexpl(1.0L, exponent - DBL_MANT_DIG));
}

static void keep_larger(double *largest, double error)
{
    if (!(error <= *largest))
        *largest = error;
}

START_TEST(exp_is_within_one_ulp)
{
    double largest = 0.0;

    bed_seed();
    for (int n = 0; n < POINTS; n++) {
        double x = n % 2 ? bed_uniform(-708.3, 709.7) : bed_uniform(-1.0, 1.0);
        keep_larger(&largest, ulps(elementary_exp(x), expl(x)));
    }
    printf("exp: %.3f ulp\n", largest);
    ck_assert_double_le(largest, 1.0);
}
END_TEST

START_TEST(log_is_within_two_ulp)
{
    double largest = 0.0;

    bed_seed();
    for (int n = 0; n < POINTS; n++) {
        double x = n % 2 ? exp(bed_uniform(-744.0, 709.0)) : bed_uniform(0.5, 2.0);
        keep_larger(&largest, ulps(elementary_log(x), logl(x)));
    }
    printf("log: %.3f ulp\n", largest);
    ck_assert_double_le(largest, 2.0);
}
END_TEST

START_TEST(sine_and_cosine_are_within_two_parts_in_1e16)
{
    double largest = 0.0;
    double sine = 0.0;
    double cosine = 0.0;

    bed_seed();
    for (int n = 0; n < POINTS; n++) {
        double x = n % 2 ? bed_uniform(-1e6, 1e6) : bed_uniform(-8.0, 8.0);
        elementary_sin_cos(x, &sine, &cosine);
        keep_larger(&largest, (double)fabsl((long double)sine - sinl(x)));
        keep_larger(&largest, (double)fabsl((long double)cosine - cosl(x)));
    }
    printf("sine and cosine: %.3g\n", largest);
    ck_assert_double_le(largest, 2e-16);
    elementary_sin_cos(INFINITY, &sine, &cosine);
    ck_assert(isnan(sine) && isnan(cosine));
    elementary_sin_cos(1.1e6, &sine, &cosine);
    ck_assert(isnan(sine) && isnan(cosine));
}
END_TEST

START_TEST(log1p_is_within_two_ulp)
{
    double largest = 0.0;

    bed_seed();
    for (int n = 0; n < POINTS; n++) {
        double x = n % 2 ? exp(bed_uniform(-700.0, 709.0)) : bed_uniform(-0.9, 2.0);
        keep_larger(&largest, ulps(elementary_log1p(x), log1pl(x)));
    }
    printf("log1p: %.3f ulp\n", largest);
    ck_assert_double_le(largest, 2.0);
}
END_TEST

START_TEST(ends_of_the_ranges)
{
    ck_assert(elementary_exp(-709.0) == 0.0 && elementary_exp(-INFINITY) == 0.0);
    ck_assert(isinf(elementary_exp(710.0)) && isinf(elementary_exp(INFINITY)));
    ck_assert(elementary_exp(0.0) == 1.0 && isnan(elementary_exp(NAN)));
    ck_assert(elementary_log(0.0) == -INFINITY && isinf(elementary_log(INFINITY)));
    ck_assert(elementary_log(1.0) == 0.0 && isnan(elementary_log(-1.0)));
    ck_assert(isnan(elementary_log(NAN)) && isnan(elementary_log1p(NAN)));
    ck_assert(elementary_log1p(0.0) == 0.0 && isinf(elementary_log1p(INFINITY)));
}
END_TEST

START_TEST(gamma_functions)
{
    double worst = 0.0;
    double worst_ratio = 0.0;

    bed_seed();
    for (int n = 0; n < POINTS / 4; n++) {
        double x = exp(bed_uniform(-3.0, 16.0));
        double s = 0.5 * (n % 17);
        long double exact = lgammal(x);
        long double ratio = lgammal((long double)x + s) - exact;
        keep_larger(&worst,
                    (double)(fabsl(elementary_log_gamma(x) - exact) / (1.0L + fabsl(exact))));
        /* The difference of two long doubles is itself only good to their size. */
        double reference = 1e-18 * (double)fabsl(exact);
        double error = (double)fabsl(elementary_log_gamma_ratio(x, s) - ratio) - reference;
        keep_larger(&worst_ratio, error / fmax(1.0, fabs((double)ratio)));
    }
    printf("log gamma: %.2g, ratio: %.2g\n", worst, worst_ratio);
    ck_assert_double_le(worst, 1e-13);
    ck_assert_double_le(worst_ratio, 1e-14);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        exp_is_within_one_ulp,   log_is_within_two_ulp,
        log1p_is_within_two_ulp, sine_and_cosine_are_within_two_parts_in_1e16,
        ends_of_the_ranges,      gamma_functions,
    };

    return SUITE_RUN("elementary functions", tests);
}
