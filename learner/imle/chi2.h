/* The chi-square distribution, for the mixture's tests. */
#ifndef REACH_LEARNER_IMLE_CHI2_H
#define REACH_LEARNER_IMLE_CHI2_H

#ifdef __cplusplus
extern "C" {
#endif

/* P(chi-square with dof > 0 degrees, not necessarily whole, <= x), to about 1e-12. 0 for x <= 0. */
double chi2_cdf(double dof, double x);

/* The x with chi2_cdf(dof, x) = p, for p in 0 .. 1; 0 at 0, INFINITY at 1. */
double chi2_quantile(double dof, double p);

#ifdef __cplusplus
}
#endif
#endif
