/* The recursive mixture: growth, E-step, M-step by rank-1 updates, shared priors. */
#include <cmath>

#include "tools/bench/reference/recursive_imle.h"
#include "tools/bench/reference/textbook_chi2.h"

namespace oracle
{

namespace
{

/* A share so small is zero: products with it would be denormal numbers, which are slow. */
const double nothing = 1e-100;

/* out = A v, and v' A v, for a symmetric d x d matrix. */
double form(size_t d, const double *A, const double *v, double *out)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++) {
        double row = 0;
        for (size_t j = 0; j < d; j++)
            row += A[i * d + j] * v[j];
        out[i] = row;
        sum += row * v[i];
    }
    return sum;
}

/* A becomes the inverse of delta A^-1 + c v v', where k = A v and g = v' A v. */
void rank_one(size_t d, double *A, const double *k, double g, double delta, double c)
{
    double factor = c / (delta + c * g);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            A[i * d + j] = (A[i * d + j] - factor * k[i] * k[j]) / delta;
}

double product(const std::vector<double> &v)
{
    double value = 1;
    for (double x : v)
        value *= x;
    return value;
}

} /* namespace */

RecursiveImle::RecursiveImle(const Parameters &parameters)
    : p_(parameters), d_(size_t(parameters.d)), D_(size_t(parameters.D)),
      c_input_(std::exp(-0.5 * chi2_quantile(p_.d, 1 - p_.p0))),
      c_joint_(std::exp(-0.5 * chi2_quantile(p_.d + p_.D, 1 - p_.p0))),
      sigma_bar_(p_.sigma0.data(), p_.sigma0.data() + p_.d),
      psi_bar_(p_.psi0.data(), p_.psi0.data() + p_.D), dz_(d_), v_(d_), dx_(D_), k_(d_)
{
}

double RecursiveImle::sigma_divisor(const Expert &e) const
{
    return e.S_h + e.w_Sigma + p_.d + 1;
}

void RecursiveImle::give_birth(const double *z, const double *x)
{
    Expert e;
    e.H = 1e-6;
    e.S_h = 0;
    e.w_Sigma = p_.w_Sigma;
    e.w_Psi = p_.w_Psi;
    e.nu.assign(z, z + d_);
    e.mu.assign(x, x + D_);
    e.Lambda.assign(D_ * d_, 0);
    e.C_inverse.assign(d_ * d_, 0);
    e.N_inverse.assign(d_ * d_, 0);
    e.ssr.assign(D_, 0);
    e.Psi = psi_bar_;
    e.log_det_N_inverse = 0;
    e.log_det_at_birth = p_.d * std::log((p_.w_Sigma + p_.d + 2) / p_.w_Sigma);
    for (size_t i = 0; i < d_; i++) {
        e.C_inverse[i * d_ + i] = 1 / (p_.w_Lambda + 1e-6);
        e.N_inverse[i * d_ + i] = 1 / (p_.w_Sigma * sigma_bar_[i] + 1e-6);
        e.log_det_N_inverse += std::log(e.N_inverse[i * d_ + i]);
        e.log_det_at_birth -= std::log(sigma_bar_[i]);
    }
    for (double &psi : e.Psi)
        psi /= 1 + 2 / p_.w_Psi;
    experts_.push_back(e);
}

double RecursiveImle::log_t(const Expert &e, double q, double *dof, double *a) const
{
    double d = p_.d;
    *dof = e.w_Sigma + e.S_h - d + 1;
    *a = (e.S_h + 1) / e.S_h * sigma_divisor(e);
    return 0.5 * (e.log_det_N_inverse + d * std::log(sigma_divisor(e))) +
           std::lgamma(0.5 * (*dof + d)) - std::lgamma(0.5 * *dof) + 0.5 * d * std::log(2 / *a) -
           0.5 * (*dof + d) * std::log1p(q / *a);
}

/* p_j(z, x) */
double RecursiveImle::joint_density(const Expert &e, const double *z, const double *x)
{
    double dof, a, misfit = 0, variances = 1;
    for (size_t i = 0; i < d_; i++)
        dz_[i] = z[i] - e.nu[i];
    double gamma = 1 / e.S_h + form(d_, e.C_inverse.data(), dz_.data(), k_.data());
    double q = sigma_divisor(e) * form(d_, e.N_inverse.data(), dz_.data(), k_.data());
    for (size_t i = 0; i < D_; i++) {
        double dx = x[i] - e.mu[i], variance = e.Psi[i] * (1 + gamma);
        for (size_t c = 0; c < d_; c++)
            dx -= e.Lambda[i * d_ + c] * dz_[c];
        misfit += dx * dx / variance;
        variances *= variance;
    }
    return std::exp(log_t(e, q, &dof, &a) - 0.5 * misfit) / std::sqrt(variances);
}

/* N(z; nu, Sigma) N(x; xhat, Psi), without the constant. */
double RecursiveImle::responsibility(const Expert &e, const double *z, const double *x)
{
    double misfit = 0;
    if (!(e.S_h > 0)) /* newborn: it sits on the sample */
        return std::exp(0.5 * e.log_det_at_birth) / std::sqrt(product(e.Psi));
    for (size_t i = 0; i < d_; i++)
        dz_[i] = z[i] - e.nu[i];
    double q = sigma_divisor(e) * form(d_, e.N_inverse.data(), dz_.data(), k_.data());
    for (size_t i = 0; i < D_; i++) {
        double dx = x[i] - e.mu[i];
        for (size_t c = 0; c < d_; c++)
            dx -= e.Lambda[i * d_ + c] * dz_[c];
        misfit += dx * dx / e.Psi[i];
    }
    double log_det = e.log_det_N_inverse + p_.d * std::log(sigma_divisor(e));
    return std::exp(0.5 * (log_det - q - misfit)) / std::sqrt(product(e.Psi));
}

void RecursiveImle::learn(Expert &e, double h, const double *z, const double *x)
{
    double decay = p_.alpha >= 1 ? 1 : (std::pow(e.H + h, p_.alpha) - h) / std::pow(e.H, p_.alpha);
    double before = decay * e.S_h, c = before * h / (before + h);
    for (size_t i = 0; i < d_; i++)
        v_[i] = z[i] - e.nu[i];
    double g = form(d_, e.C_inverse.data(), v_.data(), k_.data());
    double gain = c / (decay + c * g);
    for (size_t i = 0; i < D_; i++) {
        double r = x[i] - e.mu[i];
        for (size_t n = 0; n < d_; n++)
            r -= e.Lambda[i * d_ + n] * v_[n];
        for (size_t n = 0; n < d_; n++)
            e.Lambda[i * d_ + n] += gain * r * k_[n];
        e.ssr[i] = decay * e.ssr[i] + decay * gain * r * r;
        e.mu[i] += h / (before + h) * (x[i] - e.mu[i]);
    }
    rank_one(d_, e.C_inverse.data(), k_.data(), g, decay, c);
    g = form(d_, e.N_inverse.data(), v_.data(), k_.data());
    rank_one(d_, e.N_inverse.data(), k_.data(), g, decay, c);
    e.log_det_N_inverse -= p_.d * std::log(decay) + std::log1p(c * g / decay);
    for (size_t i = 0; i < d_; i++)
        e.nu[i] += h / (before + h) * v_[i];
    e.H += h;
    e.S_h = before + h;
    e.w_Sigma *= decay;
    e.w_Psi *= decay;
    update_noise(e);
}

void RecursiveImle::update_noise(Expert &e) const
{
    if (std::isinf(e.w_Psi)) {
        e.Psi = psi_bar_;
        return;
    }
    for (size_t i = 0; i < D_; i++)
        e.Psi[i] = (e.w_Psi * psi_bar_[i] + e.ssr[i]) / (e.w_Psi + e.S_h + 2);
}

/* The mode of a shared prior, given the sum of the experts' inverses. */
static double prior_mode(double M, double w_expert, double w_hyper, double prior, double sum)
{
    double t = (M * w_expert - w_hyper) / 2 - 1;
    return (t + std::sqrt(t * t + w_expert * w_hyper * prior * sum)) / (w_expert * sum);
}

void RecursiveImle::update_priors()
{
    Numbers s(d_, 0), inverse(D_, 0);
    for (const Expert &e : experts_) {
        for (size_t i = 0; i < d_; i++)
            s[i] += sigma_divisor(e) * e.N_inverse[i * d_ + i];
        for (size_t i = 0; i < D_; i++)
            inverse[i] += 1 / e.Psi[i];
    }
    for (size_t i = 0; i < d_; i++)
        sigma_bar_[i] =
            prior_mode(experts(), p_.w_Sigma, p_.w_sigma, p_.sigma0(Eigen::Index(i)), s[i]);
    if (std::isinf(p_.w_psi) || std::isinf(p_.w_Psi))
        return;
    for (size_t i = 0; i < D_; i++)
        psi_bar_[i] =
            prior_mode(experts(), p_.w_Psi, p_.w_psi, p_.psi0(Eigen::Index(i)), inverse[i]);
}

double RecursiveImle::outlier_input() const
{
    return c_input_ / std::sqrt(product(sigma_bar_));
}

double RecursiveImle::outlier_joint() const
{
    return c_joint_ / std::sqrt(product(psi_bar_) * product(sigma_bar_));
}

Result RecursiveImle::update(const double *z, const double *x)
{
    Result result = Result::updated;
    double sum = 0, total = 0;
    for (const Expert &e : experts_)
        sum += joint_density(e, z, x);
    if (experts_.empty() || sum < outlier_joint() / experts()) {
        if (outliers_in_row_ < p_.n_outliers) {
            outliers_in_row_++;
            return Result::outlier;
        }
        give_birth(z, x);
        result = Result::born;
    }
    outliers_in_row_ = 0;
    h_.resize(experts_.size());
    for (size_t j = 0; j < experts_.size(); j++)
        total += h_[j] = responsibility(experts_[j], z, x);
    concerned_ = 0;
    for (size_t j = 0; j < experts_.size(); j++) {
        double h = h_[j] / total;
        concerned_ += h > 1e-6;
        if (h >= p_.skip)
            learn(experts_[j], h > nothing ? h : 0, z, x);
    }
    update_priors();
    return result;
}

} /* namespace oracle */
