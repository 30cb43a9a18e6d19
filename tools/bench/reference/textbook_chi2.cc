#include "tools/bench/reference/textbook_chi2.h"

#include <unsupported/Eigen/SpecialFunctions>

namespace oracle
{

double chi2_cdf(double dof, double x)
{
    return x > 0 ? Eigen::numext::igamma(0.5 * dof, 0.5 * x) : 0.0;
}

double chi2_quantile(double dof, double level)
{
    double low = 0, high = 1e4;
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (low + high);
        (chi2_cdf(dof, middle) < level ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} /* namespace oracle */
