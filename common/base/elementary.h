/* exp, log, log1p, sine, cosine and the logarithm of gamma functions from plain arithmetic alone.
 *
 * A C library chooses its code by the processor, and the last bits of its results with it. These
 * use + - * / and bit operations in a fixed order, without branches in the inline ones so that a
 * loop over them becomes vector instructions: the same bits on every machine and vector width.
 *
 * Errors against the exact value, as tests/unit/learner/test_elementary.c measures and bounds them:
 * exp 1 ulp, log and log1p 2 ulp, sine and cosine 2e-16 in all. Coefficients:
 * tools/dev/elementary_coefficients.py. */
#ifndef REACH_COMMON_BASE_ELEMENTARY_H
#define REACH_COMMON_BASE_ELEMENTARY_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline uint64_t elementary_bits(double x)
{
    uint64_t bits;

    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double elementary_number(uint64_t bits)
{
    double x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

/* log 2 in two parts; the first has 11 zero bits at its end, so that a whole number times it is
 * exact. */
#define ELEMENTARY_LOG2_HIGH 0x1.62e42fefa3800p-1
#define ELEMENTARY_LOG2_LOW 0x1.ef35793c76730p-45

/* e^x. 0 where the result would be denormal (below -708.39), INFINITY above 709.78.
 *   x = k log 2 + r,  e^r = 1 + r + r^2 P(r) */
static inline double elementary_exp(double x)
{
    const double whole = 0x1.8p52; /* adding it rounds to a whole number, kept in the low bits */
    double lifted = x * 0x1.71547652b82fep+0 + whole;
    double k = lifted - whole;
    double r = (x - k * ELEMENTARY_LOG2_HIGH) - k * ELEMENTARY_LOG2_LOW;
    double P = 0x1.1f72fc730b4ffp-29;

    P = P * r + 0x1.af4ddd84882fep-26;
    P = P * r + 0x1.27e4db67b4303p-22;
    P = P * r + 0x1.71de02375656cp-19;
    P = P * r + 0x1.a01a01a6d7808p-16;
    P = P * r + 0x1.a01a01abe62ddp-13;
    P = P * r + 0x1.6c16c16c162d6p-10;
    P = P * r + 0x1.11111111100dfp-7;
    P = P * r + 0x1.5555555555556p-5;
    P = P * r + 0x1.5555555555557p-3;
    P = P * r + 0.5;
    double y = 1.0 + (r + r * r * P);
    double scaled = elementary_number(elementary_bits(y) + (elementary_bits(lifted) << 52));
    double low = x < -708.39 ? 0.0 : scaled;
    double high = x > 709.78 ? (double)INFINITY : low;
    return x != x ? x : high;
}

/* log m for m = 1 + f in [1/sqrt 2, sqrt 2): with s = f / (2 + f), 2 s = f - s f, and so
 * log m = 2 atanh s = f - s (f - s^2 Q(s^2)). */
static inline double elementary_log_near_one(double f)
{
    double s = f / (2.0 + f);
    double w = s * s;
    double Q = 0x1.0c039c49989c6p-3;

    Q = Q * w + 0x1.0fbe95d716020p-3;
    Q = Q * w + 0x1.3b1c355a8f7a2p-3;
    Q = Q * w + 0x1.745cf9048dd95p-3;
    Q = Q * w + 0x1.c71c720159177p-3;
    Q = Q * w + 0x1.2492492476cccp-2;
    Q = Q * w + 0x1.9999999999a38p-2;
    Q = Q * w + 0x1.5555555555555p-1;
    return f - s * (f - w * Q);
}

/* x = 2^k m with m in [1/sqrt 2, sqrt 2), for a normal x > 0. Returns m. */
static inline double elementary_split(double x, double *k)
{
    const uint64_t bias = 1023;
    /* How far x is above 1/sqrt 2 in steps of its last bit, plus the bias: k + 1023 ends up in the
     * exponent's place. */
    uint64_t above = elementary_bits(x) - 0x3fe6a09e667f3bcdULL + (bias << 52);
    uint64_t exponent = above >> 52;

    *k = elementary_number(exponent | 0x4330000000000000ULL) - (0x1p52 + 1023.0);
    return elementary_number(elementary_bits(x) - (exponent << 52) + (bias << 52));
}

/* Natural logarithm. log 0 = -INFINITY; NaN below 0. */
static inline double elementary_log(double x)
{
    double normal = x < DBL_MIN ? x * 0x1p54 : x;
    double shift = x < DBL_MIN ? -54.0 : 0.0;
    double k;
    double m = elementary_split(normal, &k);

    k += shift;
    double y = elementary_log_near_one(m - 1.0);
    y = k * ELEMENTARY_LOG2_HIGH + (y + k * ELEMENTARY_LOG2_LOW);
    y = x < (double)INFINITY ? y : x;
    y = x == 0.0 ? -(double)INFINITY : y;
    return x < 0.0 ? (double)NAN : y;
}

/* log(1 + x) for x > -1, exact to the last bits for small x too. What rounding 1 + x loses is put
 * back to first order. */
static inline double elementary_log1p(double x)
{
    double u = 1.0 + x;
    double lost = (x - (u - 1.0)) / u;
    double k;
    double m = elementary_split(u, &k);
    double f = k == 0.0 ? x : m - 1.0;
    double put_back = k == 0.0 ? 0.0 : lost;
    double y = elementary_log_near_one(f) + put_back;

    y = k * ELEMENTARY_LOG2_HIGH + (y + k * ELEMENTARY_LOG2_LOW);
    return x < (double)INFINITY ? y : x;
}

/* pi / 2 in three parts; the first two have 20 zero bits at their end, so that a whole number below
 * 2^20 times one of them is exact. */
#define ELEMENTARY_HALF_PI_HIGH 0x1.921fb54400000p+0
#define ELEMENTARY_HALF_PI_MIDDLE 0x1.0b4611a600000p-34
#define ELEMENTARY_HALF_PI_LOW 0x1.3198a2e037073p-69

/* Sine and cosine of x, |x| <= 1e6; beyond that, and for what is no number, NaN.
 *   x = k pi / 2 + r, |r| <= pi / 4, and Taylor's series of both at r: what follows the last term
 * is under 1e-17. */
static inline void elementary_sin_cos(double x, double *sine, double *cosine)
{
    const double whole = 0x1.8p52;
    double lifted = x * 0x1.45f306dc9c883p-1 + whole;
    double k = lifted - whole;
    double r = ((x - k * ELEMENTARY_HALF_PI_HIGH) - k * ELEMENTARY_HALF_PI_MIDDLE) -
               k * ELEMENTARY_HALF_PI_LOW;
    double w = r * r;
    double S = 1.0 / 355687428096000.0;
    double C = 1.0 / 20922789888000.0;
    uint64_t quarter = elementary_bits(lifted) & 3;

    S = 1.0 / 1307674368000.0 - w * S;
    S = 1.0 / 6227020800.0 - w * S;
    S = 1.0 / 39916800.0 - w * S;
    S = 1.0 / 362880.0 - w * S;
    S = 1.0 / 5040.0 - w * S;
    S = 1.0 / 120.0 - w * S;
    S = 1.0 / 6.0 - w * S;
    S = r - r * w * S;
    C = 1.0 / 87178291200.0 - w * C;
    C = 1.0 / 479001600.0 - w * C;
    C = 1.0 / 3628800.0 - w * C;
    C = 1.0 / 40320.0 - w * C;
    C = 1.0 / 720.0 - w * C;
    C = 1.0 / 24.0 - w * C;
    C = 1.0 - (0.5 * w - w * w * C);
    double first = quarter & 1 ? C : S;
    double second = quarter & 1 ? S : C;
    double usable = fabs(x) <= 1e6 ? 0.0 : (double)NAN;

    *sine = (quarter & 2 ? -first : first) + usable;
    *cosine = (quarter == 1 || quarter == 2 ? -second : second) + usable;
}

/* log Gamma(x) for x > 0; absolute error below 1e-13 (1 + |result|). */
double elementary_log_gamma(double x);

/* log(Gamma(x + s) / Gamma(x)) for x > 0, s >= 0; relative error below 1e-14 times the larger of 1
 * and the result, however large x is (the difference of two log Gamma would lose it all). */
double elementary_log_gamma_ratio(double x, double s);

#ifdef __cplusplus
}
#endif
#endif
