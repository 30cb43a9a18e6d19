#include "common/base/elementary.h"

/* From here on Stirling's series is good to the last bit. */
static const double large = 16.0;

/* What Stirling's formula leaves: sum B_2n / (2n (2n-1) x^(2n-1)), B the Bernoulli numbers. */
static double stirling_rest(double x)
{
    static const double terms[] = {1.0 / 12.0,   -1.0 / 360.0,      1.0 / 1260.0, -1.0 / 1680.0,
                                   1.0 / 1188.0, -691.0 / 360360.0, 1.0 / 156.0};
    double w = 1.0 / (x * x);
    double sum = 0.0;

    for (int n = (int)(sizeof terms / sizeof terms[0]) - 1; n >= 0; n--)
        sum = sum * w + terms[n];
    return sum / x;
}

double elementary_log_gamma(double x)
{
    const double half_log_two_pi = 0x1.d67f1c864beb5p-1;
    double product = 1.0;

    for (; x < large; x += 1.0)
        product *= x;
    return ((x - 0.5) * elementary_log(x) - x) +
           (half_log_two_pi + stirling_rest(x) - elementary_log(product));
}

/* Stirling for both, arranged so that nothing large cancels:
 *   (x - 1/2) log(1 + s/x) + s log(x + s) - s + rest(x + s) - rest(x) */
double elementary_log_gamma_ratio(double x, double s)
{
    double product = 1.0;

    for (; x < large; x += 1.0)
        product *= x / (x + s);
    return (x - 0.5) * elementary_log1p(s / x) + s * (elementary_log(x + s) - 1.0) +
           (stirling_rest(x + s) - stirling_rest(x)) + elementary_log(product);
}
