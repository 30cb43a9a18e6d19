/* The textbook mixture: what one expert says to a query, and what outliers are measured by. */
#include <cmath>

#include "tools/bench/reference/textbook_chi2.h"
#include "tools/bench/reference/textbook_imle.h"

namespace oracle
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

double TextbookImle::sigma_divisor(const Expert &e) const
{
    return e.S_h + e.w_Sigma + p_.d + 1 + (p_.w_nu > 0 ? 1 : 0);
}

MatrixXd TextbookImle::inverse_C(const Expert &e) const
{
    MatrixXd C =
        e.S_zz - e.S_z * e.S_z.transpose() / e.S_h + e.w_Lambda * MatrixXd::Identity(p_.d, p_.d);
    return C.inverse();
}

TextbookImle::Answer TextbookImle::answer(const Expert &e, const VectorXd &z) const
{
    Answer r;
    MatrixXd precision = e.Sigma.inverse();
    MatrixXd C_inverse = inverse_C(e);
    VectorXd dz = z - e.nu;
    VectorXd from_mean = z - e.S_z / e.S_h;
    double dof = e.w_Sigma + e.S_h - p_.d + 1;
    double a = (e.w_nu + e.S_h + 1) / (e.w_nu + e.S_h) * sigma_divisor(e);
    double q = dz.dot(precision * dz);
    r.t = std::sqrt(precision.determinant()) *
          std::exp(std::lgamma(0.5 * (dof + p_.d)) - std::lgamma(0.5 * dof)) *
          std::pow(2 / a, 0.5 * p_.d) * std::pow(1 + q / a, -0.5 * (dof + p_.d));
    r.gamma = 1 / e.S_h + from_mean.dot(C_inverse * from_mean);
    r.x = e.mu + e.Lambda * dz;
    r.kappa = (dof + p_.d) / (a + q) * (precision * dz);
    r.dgamma = 2 * C_inverse * from_mean;
    return r;
}

double TextbookImle::outlier_input() const
{
    return std::exp(-0.5 * chi2_quantile(p_.d, 1 - p_.p0)) / std::sqrt(sigma_bar_.prod());
}

double TextbookImle::outlier_joint() const
{
    return std::exp(-0.5 * chi2_quantile(p_.d + p_.D, 1 - p_.p0)) /
           std::sqrt(psi_bar_.prod() * sigma_bar_.prod());
}

} /* namespace oracle */
