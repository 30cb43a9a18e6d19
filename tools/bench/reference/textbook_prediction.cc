/* The textbook mixture: predictions, clusters, Jacobians. */
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tools/bench/reference/textbook_chi2.h"
#include "tools/bench/reference/textbook_imle.h"

namespace oracle
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<TextbookImle::Answer> TextbookImle::answers(const VectorXd &z) const
{
    std::vector<Answer> all;
    double W = outlier_input();
    for (const Expert &e : experts_) {
        all.push_back(answer(e, z));
        W += all.back().t;
    }
    for (Answer &a : all)
        a.phi = a.t / (a.gamma * a.t + W);
    return all;
}

double TextbookImle::deviation(const Answer &a, int expert, const VectorXd &center) const
{
    VectorXd dx = a.x - center;
    return a.phi * dx.cwiseQuotient(experts_[size_t(expert)].Psi).dot(dx);
}

/* Value, variance, weight and Jacobian of the experts `members`. */
Solution TextbookImle::fuse(const std::vector<Answer> &all, const std::vector<int> &members) const
{
    Solution s;
    double inside = 0, total = outlier_input();
    VectorXd dW = VectorXd::Zero(p_.d), sum = VectorXd::Zero(p_.D), precision = sum;
    for (const Answer &a : all)
        total += a.t;
    for (int j : members) {
        inside += all[size_t(j)].t;
        dW -= all[size_t(j)].t * all[size_t(j)].kappa;
    }
    double W = inside + outlier_input();
    for (int j : members) {
        const Answer &a = all[size_t(j)];
        VectorXd weight = a.t / (a.gamma * a.t + W) * experts_[size_t(j)].Psi.cwiseInverse();
        sum += weight.cwiseProduct(a.x);
        precision += weight;
    }
    s.value = sum.cwiseQuotient(precision);
    s.variance = precision.cwiseInverse();
    s.weight = inside / total;
    s.jacobian = MatrixXd::Zero(p_.D, p_.d);
    for (int j : members) {
        const Answer &a = all[size_t(j)];
        const Expert &e = experts_[size_t(j)];
        double bottom = a.gamma * a.t + W;
        VectorXd dt = -a.t * a.kappa;
        VectorXd dphi = (W * dt - a.t * a.t * a.dgamma - a.t * dW) / (bottom * bottom);
        for (int i = 0; i < p_.D; i++)
            s.jacobian.row(i) += (a.t / bottom / e.Psi(i) * e.Lambda.row(i) +
                                  (a.x(i) - s.value(i)) / e.Psi(i) * dphi.transpose()) /
                                 precision(i);
    }
    return s;
}

VectorXd TextbookImle::precision(const Answer &a, int expert) const
{
    return a.phi * experts_[size_t(expert)].Psi.cwiseInverse();
}

/* Mean of all answers, each weighted by R_j^-1 and its probability. */
VectorXd TextbookImle::center(const std::vector<Answer> &all, const VectorXd &probability,
                              const VectorXd &otherwise) const
{
    VectorXd top = VectorXd::Zero(p_.D), bottom = top;
    for (int j = 0; j < experts(); j++) {
        VectorXd weight = probability(j) * precision(all[size_t(j)], j);
        top += weight.cwiseProduct(all[size_t(j)].x);
        bottom += weight;
    }
    return (bottom.array() > 0).all() ? VectorXd(top.cwiseQuotient(bottom)) : otherwise;
}

double TextbookImle::level(const std::vector<Answer> &all, const Cluster &cluster) const
{
    double T = 0, t = 0, tt = 0;
    for (int j : cluster.members) {
        T += deviation(all[size_t(j)], j, cluster.center);
        t += all[size_t(j)].t;
        tt += all[size_t(j)].t * all[size_t(j)].t;
    }
    return cluster.members.size() < 2 ? 0 : chi2_cdf((t * t / tt - 1) * p_.D + 1, T);
}

int TextbookImle::farthest(const std::vector<Answer> &all, const Cluster &cluster,
                           const VectorXd &x) const
{
    return *std::max_element(cluster.members.begin(), cluster.members.end(), [&](int i, int j) {
        return deviation(all[size_t(i)], i, x) < deviation(all[size_t(j)], j, x);
    });
}

void TextbookImle::em_iteration(const std::vector<Answer> &all,
                                std::vector<Cluster> &clusters) const
{
    MatrixXd p(experts(), Eigen::Index(clusters.size()));
    for (int j = 0; j < experts(); j++) {
        for (size_t k = 0; k < clusters.size(); k++)
            p(j, Eigen::Index(k)) = -0.5 * deviation(all[size_t(j)], j, clusters[k].center);
        p.row(j) = (p.row(j).array() - p.row(j).maxCoeff()).exp();
        p.row(j) /= p.row(j).sum();
    }
    for (size_t k = 0; k < clusters.size(); k++)
        clusters[k].center = center(all, p.col(Eigen::Index(k)), clusters[k].center);
}

void TextbookImle::assign(const std::vector<Answer> &all, std::vector<Cluster> &clusters) const
{
    for (Cluster &cluster : clusters)
        cluster.members.clear();
    for (int j = 0; j < experts(); j++)
        std::min_element(clusters.begin(), clusters.end(), [&](const Cluster &a, const Cluster &b) {
            return deviation(all[size_t(j)], j, a.center) < deviation(all[size_t(j)], j, b.center);
        })->members.push_back(j);
    clusters.erase(std::remove_if(clusters.begin(), clusters.end(),
                                  [](const Cluster &c) { return c.members.empty(); }),
                   clusters.end());
}

std::vector<TextbookImle::Cluster> TextbookImle::cluster(const std::vector<Answer> &all) const
{
    std::vector<Cluster> clusters(1);
    for (int j = 0; j < experts(); j++)
        clusters[0].members.push_back(j);
    clusters[0].center = center(all, VectorXd::Ones(experts()), VectorXd());
    while (int(clusters.size()) < p_.n_solutions_max) {
        size_t before = clusters.size();
        auto worst = std::max_element(
            clusters.begin(), clusters.end(),
            [&](const Cluster &a, const Cluster &b) { return level(all, a) < level(all, b); });
        if (level(all, *worst) <= p_.significance)
            break;
        int first = farthest(all, *worst, worst->center);
        int second = farthest(all, *worst, all[size_t(first)].x);
        worst->center = all[size_t(first)].x;
        clusters.push_back({{}, all[size_t(second)].x});
        for (int iteration = 0; iteration < p_.em_pred_iterations; iteration++)
            em_iteration(all, clusters);
        assign(all, clusters);
        if (clusters.size() <= before)
            break;
    }
    return clusters;
}

std::vector<Solution> TextbookImle::predict(const VectorXd &z) const
{
    std::vector<Solution> solutions;
    std::vector<Answer> all = answers(z);
    for (const Cluster &c : cluster(all))
        solutions.push_back(fuse(all, c.members));
    std::stable_sort(solutions.begin(), solutions.end(),
                     [](const Solution &a, const Solution &b) { return a.weight > b.weight; });
    return solutions;
}

Solution TextbookImle::predict_single(const VectorXd &z) const
{
    std::vector<int> everyone(experts_.size());
    std::iota(everyone.begin(), everyone.end(), 0);
    return fuse(answers(z), everyone);
}

} /* namespace oracle */
