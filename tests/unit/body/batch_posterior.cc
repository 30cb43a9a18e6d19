#include "batch_posterior.h"

#include <Eigen/Cholesky>
#include <cmath>

void BatchPosterior::add(const Eigen::MatrixXd &Phi, const Eigen::Vector3d &value, double weight)
{
    rows.push_back(Phi);
    y.push_back(value);
    h.push_back(weight);
}

Eigen::MatrixXd BatchPosterior::information(int size) const
{
    Eigen::MatrixXd C = Eigen::MatrixXd::Identity(size, size);

    for (size_t n = 0; n < rows.size(); n++)
        C += h[n] * rows[n].leftCols(size).transpose() * rows[n].leftCols(size);
    return C;
}

Eigen::VectorXd BatchPosterior::mean(int size) const
{
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size);

    for (size_t n = 0; n < rows.size(); n++)
        b += h[n] * rows[n].leftCols(size).transpose() * y[n];
    return information(size).llt().solve(b);
}

double BatchPosterior::log_marginal_likelihood(int size) const
{
    auto N = static_cast<Eigen::Index>(3 * rows.size());
    Eigen::MatrixXd Phi(N, size);
    Eigen::VectorXd all(N);

    for (size_t n = 0; n < rows.size(); n++) {
        Phi.middleRows(static_cast<Eigen::Index>(3 * n), 3) = rows[n].leftCols(size);
        all.segment(static_cast<Eigen::Index>(3 * n), 3) = y[n];
    }
    Eigen::MatrixXd S = Eigen::MatrixXd::Identity(N, N) + Phi * Phi.transpose();
    Eigen::LLT<Eigen::MatrixXd> L(S);
    return -0.5 * all.dot(L.solve(all)) -
           Eigen::MatrixXd(L.matrixL()).diagonal().array().log().sum();
}
