/* The textbook mixture: E-step, M-step, growth, shared priors. */
#include <cmath>

#include "tools/bench/reference/textbook_imle.h"

namespace oracle
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

TextbookImle::TextbookImle(const Parameters &parameters)
    : p_(parameters), sigma_bar_(parameters.sigma0), psi_bar_(parameters.psi0)
{
}

TextbookImle::Expert TextbookImle::newborn(const VectorXd &z, const VectorXd &x) const
{
    Expert e;
    e.H = 1e-6;
    e.S_h = 0;
    e.w_nu = p_.w_nu;
    e.w_Sigma = p_.w_Sigma;
    e.w_Lambda = p_.w_Lambda;
    e.w_Psi = p_.w_Psi;
    e.S_z = VectorXd::Zero(p_.d);
    e.S_x = VectorXd::Zero(p_.D);
    e.S_xx = VectorXd::Zero(p_.D);
    e.S_xz = MatrixXd::Zero(p_.D, p_.d);
    e.S_zz = 1e-6 * MatrixXd::Identity(p_.d, p_.d);
    e.nu_0 = z;
    e.sigma_birth = sigma_bar_;
    e.nu = z;
    e.mu = x;
    e.Lambda = MatrixXd::Zero(p_.D, p_.d);
    e.Sigma = p_.w_Sigma / (p_.w_Sigma + p_.d + 2) * MatrixXd(sigma_bar_.asDiagonal());
    e.Psi = psi_bar_ / (1 + 2 / p_.w_Psi);
    return e;
}

double TextbookImle::responsibility(const Expert &e, const VectorXd &z, const VectorXd &x) const
{
    VectorXd dz = z - e.nu;
    VectorXd dx = x - e.mu - e.Lambda * dz;
    double q = dz.dot(e.Sigma.inverse() * dz);
    double r = dx.cwiseQuotient(e.Psi).dot(dx);
    return std::exp(-0.5 * (q + r)) / std::sqrt(e.Sigma.determinant() * e.Psi.prod());
}

void TextbookImle::m_step(Expert &e) const
{
    VectorXd zbar = e.S_z / e.S_h;
    VectorXd xbar = e.S_x / e.S_h;
    MatrixXd prior = e.w_Sigma * MatrixXd(e.sigma_birth.asDiagonal());
    e.nu = (e.w_nu * e.nu_0 + e.S_z) / (e.w_nu + e.S_h);
    e.Sigma = (prior + e.S_zz + e.w_nu * e.nu_0 * e.nu_0.transpose() -
               (e.w_nu + e.S_h) * e.nu * e.nu.transpose()) /
              sigma_divisor(e);
    MatrixXd C_xz = e.S_xz - xbar * e.S_z.transpose();
    e.Lambda = C_xz * inverse_C(e);
    e.mu = xbar + e.Lambda * (e.nu - zbar);
    if (std::isinf(e.w_Psi)) {
        e.Psi = psi_bar_;
        return;
    }
    VectorXd residual =
        e.S_xx - xbar.cwiseProduct(e.S_x) - C_xz.cwiseProduct(e.Lambda).rowwise().sum();
    e.Psi = (e.w_Psi * psi_bar_ + residual) / (e.w_Psi + e.S_h + 2);
}

void TextbookImle::learn(Expert &e, double h, const VectorXd &z, const VectorXd &x) const
{
    double decay = p_.alpha >= 1 ? 1 : (std::pow(e.H + h, p_.alpha) - h) / std::pow(e.H, p_.alpha);
    e.H += h;
    e.S_h = decay * e.S_h + h;
    e.S_z = decay * e.S_z + h * z;
    e.S_x = decay * e.S_x + h * x;
    e.S_xz = decay * e.S_xz + h * x * z.transpose();
    e.S_zz = decay * e.S_zz + h * z * z.transpose();
    e.S_xx = decay * e.S_xx + h * x.cwiseProduct(x);
    e.w_Lambda *= decay;
    e.w_Sigma = std::max({decay * e.w_Sigma, p_.floor * p_.w_Sigma, double(p_.d)});
    e.w_nu = std::max(decay * e.w_nu, p_.floor * p_.w_nu);
    e.w_Psi = std::max(decay * e.w_Psi, p_.floor * p_.w_Psi);
    m_step(e);
}

void TextbookImle::update_priors()
{
    VectorXd s = VectorXd::Zero(p_.d), p = VectorXd::Zero(p_.D);
    double M = experts();
    for (const Expert &e : experts_) {
        s += e.Sigma.inverse().diagonal();
        p += e.Psi.cwiseInverse();
    }
    double t = (M * p_.w_Sigma - p_.w_sigma) / 2 - 1;
    for (int i = 0; i < p_.d; i++)
        sigma_bar_(i) = (t + std::sqrt(t * t + p_.w_Sigma * p_.w_sigma * p_.sigma0(i) * s(i))) /
                        (p_.w_Sigma * s(i));
    if (std::isinf(p_.w_psi) || std::isinf(p_.w_Psi))
        return;
    t = (M * p_.w_Psi - p_.w_psi) / 2 - 1;
    for (int i = 0; i < p_.D; i++)
        psi_bar_(i) =
            (t + std::sqrt(t * t + p_.w_Psi * p_.w_psi * p_.psi0(i) * p(i))) / (p_.w_Psi * p(i));
}

double TextbookImle::joint_density(const Expert &e, const VectorXd &z, const VectorXd &x) const
{
    Answer a = answer(e, z);
    VectorXd variance = e.Psi * (1 + a.gamma);
    VectorXd dx = x - a.x;
    return a.t / std::sqrt(variance.prod()) * std::exp(-0.5 * dx.cwiseQuotient(variance).dot(dx));
}

Result TextbookImle::update(const VectorXd &z, const VectorXd &x)
{
    Result result = Result::updated;
    double sum = 0;
    for (const Expert &e : experts_)
        sum += joint_density(e, z, x);
    if (experts_.empty() || sum < outlier_joint() / experts()) {
        if (outliers_in_row_ < p_.n_outliers) {
            outliers_in_row_++;
            return Result::outlier;
        }
        experts_.push_back(newborn(z, x));
        result = Result::born;
    }
    outliers_in_row_ = 0;
    std::vector<double> h;
    double total = 0;
    for (const Expert &e : experts_) {
        h.push_back(responsibility(e, z, x));
        total += h.back();
    }
    for (size_t j = 0; j < experts_.size(); j++)
        if (h[j] / total > p_.skip)
            learn(experts_[j], h[j] / total, z, x);
    update_priors();
    return result;
}

} /* namespace oracle */
