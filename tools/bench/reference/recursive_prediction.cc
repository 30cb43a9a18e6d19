/* The recursive mixture: multi-valued prediction with the exact Jacobian. */
#include <algorithm>
#include <cmath>

#include "tools/bench/reference/recursive_imle.h"
#include "tools/bench/reference/textbook_chi2.h"

namespace oracle
{

/* Expert j's answer to the query; returns its t. */
double RecursiveImle::answer_of(size_t j, const double *z)
{
    const Expert &e = experts_[j];
    Answer &answer = answers_[j];
    double *Nv = &precision_[j * d_], *Cv = &dgamma_[j * d_];
    double q = 0, g = 0, dof, a;
    for (size_t i = 0; i < d_; i++)
        dz_[i] = z[i] - e.nu[i];
    for (size_t i = 0; i < d_; i++) {
        double n = 0, c = 0;
        for (size_t k = 0; k < d_; k++) {
            n += e.N_inverse[i * d_ + k] * dz_[k];
            c += e.C_inverse[i * d_ + k] * dz_[k];
        }
        Nv[i] = sigma_divisor(e) * n;
        Cv[i] = 2 * c;
        q += Nv[i] * dz_[i];
        g += c * dz_[i];
    }
    answer.q = q;
    answer.gamma = 1 / e.S_h + g;
    answer.t = std::exp(log_t(e, q, &dof, &a));
    answer.kappa_factor = (dof + p_.d) / (a + q);
    for (size_t i = 0; i < D_; i++) {
        double x = e.mu[i];
        for (size_t k = 0; k < d_; k++)
            x += e.Lambda[i * d_ + k] * dz_[k];
        xhat_[j * D_ + i] = x;
    }
    return answer.t;
}

/* Every expert's answer to the query. */
void RecursiveImle::answer_all(const double *z)
{
    double W = outlier_input();
    answers_.resize(experts_.size());
    xhat_.resize(experts_.size() * D_);
    R_inverse_.resize(experts_.size() * D_);
    precision_.resize(experts_.size() * d_);
    dgamma_.resize(experts_.size() * d_);
    for (size_t j = 0; j < experts_.size(); j++)
        W += answer_of(j, z);
    for (size_t j = 0; j < experts_.size(); j++) {
        double phi = answers_[j].t / (answers_[j].gamma * answers_[j].t + W);
        for (size_t i = 0; i < D_; i++)
            R_inverse_[j * D_ + i] = phi / experts_[j].Psi[i];
    }
}

/* (xhat_j - x)' R_j^-1 (xhat_j - x) */
double RecursiveImle::deviation(size_t j, const double *center) const
{
    double sum = 0;
    for (size_t i = 0; i < D_; i++) {
        double dx = xhat_[j * D_ + i] - center[i];
        sum += dx * dx * R_inverse_[j * D_ + i];
    }
    return sum;
}

/* Mean of all answers, each weighted by R_j^-1 and its probability (NULL: 1). */
void RecursiveImle::move_center(size_t k, const double *probability)
{
    Numbers top(D_, 0), bottom(D_, 0);
    for (size_t j = 0; j < experts_.size(); j++)
        for (size_t i = 0; i < D_; i++) {
            double weight = (probability ? probability[j] : 1) * R_inverse_[j * D_ + i];
            top[i] += weight * xhat_[j * D_ + i];
            bottom[i] += weight;
        }
    if (*std::min_element(bottom.begin(), bottom.end()) > 0)
        for (size_t i = 0; i < D_; i++)
            centers_[k * D_ + i] = top[i] / bottom[i];
}

double RecursiveImle::level(int cluster) const
{
    double T = 0, t = 0, tt = 0;
    int members = 0;
    for (size_t j = 0; j < experts_.size(); j++) {
        if (answers_[j].cluster != cluster)
            continue;
        T += deviation(j, &centers_[size_t(cluster) * D_]);
        t += answers_[j].t;
        tt += answers_[j].t * answers_[j].t;
        members++;
    }
    return members < 2 ? 0 : chi2_cdf((t * t / tt - 1) * p_.D + 1, T);
}

size_t RecursiveImle::farthest(int cluster, const double *x) const
{
    size_t best = 0;
    double largest = -1;
    for (size_t j = 0; j < experts_.size(); j++) {
        if (answers_[j].cluster != cluster)
            continue;
        double distance = deviation(j, x);
        if (distance > largest) {
            largest = distance;
            best = j;
        }
    }
    return best;
}

void RecursiveImle::em_iteration()
{
    size_t M = experts_.size(), n = centers_.size() / D_;
    probability_.resize(n * M);
    for (size_t j = 0; j < M; j++) {
        double nearest = INFINITY, sum = 0;
        for (size_t k = 0; k < n; k++) {
            probability_[k * M + j] = 0.5 * deviation(j, &centers_[k * D_]);
            nearest = std::min(nearest, probability_[k * M + j]);
        }
        for (size_t k = 0; k < n; k++)
            sum += probability_[k * M + j] = std::exp(nearest - probability_[k * M + j]);
        for (size_t k = 0; k < n; k++)
            probability_[k * M + j] /= sum;
    }
    for (size_t k = 0; k < n; k++)
        move_center(k, &probability_[k * M]);
}

/* Each answer to its most probable cluster. False when a cluster was dropped. */
bool RecursiveImle::assign()
{
    size_t n = centers_.size() / D_, kept = 0;
    std::vector<int> members(n, 0), renamed(n, 0);
    for (size_t j = 0; j < experts_.size(); j++) {
        double least = INFINITY;
        for (size_t k = 0; k < n; k++) {
            double distance = deviation(j, &centers_[k * D_]);
            if (distance < least) {
                least = distance;
                answers_[j].cluster = int(k);
            }
        }
        members[size_t(answers_[j].cluster)]++;
    }
    for (size_t k = 0; k < n; k++) {
        renamed[k] = int(kept);
        if (members[k] == 0)
            continue;
        std::copy_n(&centers_[k * D_], D_, &centers_[kept * D_]);
        kept++;
    }
    for (Answer &answer : answers_)
        answer.cluster = renamed[size_t(answer.cluster)];
    centers_.resize(kept * D_);
    return kept == n;
}

/* Returns the number of clusters. */
int RecursiveImle::cluster()
{
    int n = 1;
    for (Answer &answer : answers_)
        answer.cluster = 0;
    centers_.assign(D_, 0);
    move_center(0, nullptr);
    while (n < p_.n_solutions_max) {
        int worst = 0;
        double largest = -1;
        for (int k = 0; k < n; k++)
            if (double l = level(k); l > largest) {
                largest = l;
                worst = k;
            }
        if (largest <= p_.significance)
            break;
        size_t first = farthest(worst, &centers_[size_t(worst) * D_]);
        size_t second = farthest(worst, &xhat_[first * D_]);
        std::copy_n(&xhat_[first * D_], D_, &centers_[size_t(worst) * D_]);
        centers_.insert(centers_.end(), &xhat_[second * D_], &xhat_[second * D_] + D_);
        for (int iteration = 0; iteration < p_.em_pred_iterations; iteration++)
            em_iteration();
        bool grown = assign();
        n = int(centers_.size() / D_);
        if (!grown)
            break;
    }
    return n;
}

void RecursiveImle::add_jacobian(size_t j, double W, const Numbers &dW, const Numbers &precision,
                                 Solution &s) const
{
    const Answer &answer = answers_[j];
    const Expert &e = experts_[j];
    double t = answer.t, bottom = answer.gamma * t + W;
    for (size_t c = 0; c < d_; c++) {
        double dt = -t * answer.kappa_factor * precision_[j * d_ + c];
        double dphi = (W * dt - t * t * dgamma_[j * d_ + c] - t * dW[c]) / (bottom * bottom);
        for (size_t i = 0; i < D_; i++)
            s.jacobian(Eigen::Index(i), Eigen::Index(c)) +=
                (t / bottom * e.Lambda[i * d_ + c] +
                 (xhat_[j * D_ + i] - s.value(Eigen::Index(i))) * dphi) /
                (e.Psi[i] * precision[i]);
    }
}

/* Value, variance, weight and Jacobian of one cluster. */
Solution RecursiveImle::fuse(int cluster) const
{
    Solution s;
    double inside = 0, total = outlier_input();
    Numbers dW(d_, 0), sum(D_, 0), precision(D_, 0);
    for (size_t j = 0; j < experts_.size(); j++) {
        total += answers_[j].t;
        if (answers_[j].cluster != cluster)
            continue;
        inside += answers_[j].t;
        for (size_t c = 0; c < d_; c++)
            dW[c] -= answers_[j].t * answers_[j].kappa_factor * precision_[j * d_ + c];
    }
    double W = inside + outlier_input();
    for (size_t j = 0; j < experts_.size(); j++) {
        if (answers_[j].cluster != cluster)
            continue;
        double phi = answers_[j].t / (answers_[j].gamma * answers_[j].t + W);
        for (size_t i = 0; i < D_; i++) {
            sum[i] += phi / experts_[j].Psi[i] * xhat_[j * D_ + i];
            precision[i] += phi / experts_[j].Psi[i];
        }
    }
    s.value.resize(p_.D);
    s.variance.resize(p_.D);
    for (size_t i = 0; i < D_; i++) {
        s.value(Eigen::Index(i)) = sum[i] / precision[i];
        s.variance(Eigen::Index(i)) = 1 / precision[i];
    }
    s.weight = inside / total;
    s.jacobian = Eigen::MatrixXd::Zero(p_.D, p_.d);
    for (size_t j = 0; j < experts_.size(); j++)
        if (answers_[j].cluster == cluster)
            add_jacobian(j, W, dW, precision, s);
    return s;
}

const std::vector<Solution> &RecursiveImle::predict(const double *z)
{
    solutions_.clear();
    if (experts_.empty())
        return solutions_;
    answer_all(z);
    int n = cluster();
    for (int k = 0; k < n; k++)
        solutions_.push_back(fuse(k));
    std::stable_sort(solutions_.begin(), solutions_.end(),
                     [](const Solution &a, const Solution &b) { return a.weight > b.weight; });
    return solutions_;
}

} /* namespace oracle */
