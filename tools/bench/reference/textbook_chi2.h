/* The chi-square distribution of the textbook mixture, by Eigen's special functions. */
#ifndef REACH_TEXTBOOK_CHI2_H
#define REACH_TEXTBOOK_CHI2_H

namespace oracle
{
double chi2_cdf(double dof, double x);
double chi2_quantile(double dof, double level);
} /* namespace oracle */

#endif
