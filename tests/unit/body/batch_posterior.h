/* A regression whose rows share their coefficients, by the formulas of a textbook and all samples
 * at once: what learner/body/tool/tied.c carries from sample to sample. */
#ifndef REACH_TEST_BODY_BATCH_POSTERIOR_H
#define REACH_TEST_BODY_BATCH_POSTERIOR_H

#include <Eigen/Core>
#include <vector>

/* y = Phi theta + noise, theta ~ N(0, I), noise ~ N(0, I), weighted by h. */
struct BatchPosterior {
    std::vector<Eigen::MatrixXd> rows; /* 3 x P */
    std::vector<Eigen::Vector3d> y;
    std::vector<double> h;

    void add(const Eigen::MatrixXd &Phi, const Eigen::Vector3d &value, double weight);

    /* I + sum h Phi' Phi and sum h Phi' y of the first `size` coefficients. */
    Eigen::MatrixXd information(int size) const;
    Eigen::VectorXd mean(int size) const;

    /* log p(all y) with weights of 1: that of N(0, I + Phi Phi'), all rows stacked, without the
     * constant of pi. */
    double log_marginal_likelihood(int size) const;
};

#endif
