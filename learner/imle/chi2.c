#include "learner/imle/chi2.h"

#include <math.h>

#include "common/base/elementary.h"

/* Enough for any dof that a mixture can have; both expansions stop by themselves well before. */
enum { MOST_TERMS = 10000, BISECTIONS = 200 };

/* Regularised lower incomplete gamma function by its power series; for x < a + 1. */
static double lower_series(double a, double x)
{
    double term = 1.0 / a;
    double sum = term;

    for (int n = 1; n < MOST_TERMS && term > sum * 1e-17; n++) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * elementary_exp(a * elementary_log(x) - x - elementary_log_gamma(a));
}

/* The upper one by its continued fraction (Legendre's, evaluated forward); for x >= a + 1. */
static double upper_fraction(double a, double x)
{
    const double tiny = 1e-300;
    double b = x + 1.0 - a;
    double c = 1.0 / tiny;
    double d = 1.0 / b;
    double fraction = d;

    for (int n = 1; n < MOST_TERMS; n++) {
        double numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        d = 1.0 / (fabs(d) < tiny ? tiny : d);
        c = b + numerator / c;
        c = fabs(c) < tiny ? tiny : c;
        fraction *= d * c;
        if (fabs(d * c - 1.0) < 1e-16)
            break;
    }
    return fraction * elementary_exp(a * elementary_log(x) - x - elementary_log_gamma(a));
}

double chi2_cdf(double dof, double x)
{
    double a = 0.5 * dof;
    double half = 0.5 * x;

    if (!(x > 0.0))
        return 0.0;
    if (isinf(x))
        return 1.0;
    return half < a + 1.0 ? lower_series(a, half) : 1.0 - upper_fraction(a, half);
}

double chi2_quantile(double dof, double p)
{
    double low = 0.0;
    double high = dof + 10.0;

    if (p <= 0.0)
        return 0.0;
    if (p >= 1.0)
        return INFINITY;
    while (chi2_cdf(dof, high) < p && high < 1e6)
        high *= 2.0;
    for (int i = 0; i < BISECTIONS && low < high; i++) {
        double middle = 0.5 * (low + high);
        if (chi2_cdf(dof, middle) < p)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}
