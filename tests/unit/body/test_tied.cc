/* The regression with shared coefficients against the batch posterior: all three nested sizes, the
 * evidence for each, weights, forgetting, and a million samples. */
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "batch_posterior.h"
#include "learner/body/tool/tied.h"
/* After the C++ headers: Check takes the word `fail`. */
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

namespace
{

using RowMajor = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;

enum { SPARE = 8 }; /* kernels may look at so many numbers behind */

struct Regression {
    design sizes{};
    const kernels *loops = kernels_of(LEARNER_KERNELS_AUTO);
    std::vector<double> numbers, scratch_numbers, rows;
    tied regression{};
    tied_scratch scratch{};
    tied_fit fit{};

    explicit Regression(int n_joints)
    {
        struct body body = made_up_arm(n_joints, false);
        design_init(&sizes, &body);
        numbers.resize(tied_numbers(&sizes) + SPARE);
        scratch_numbers.resize(tied_scratch_numbers(&sizes) + SPARE);
        tied_place(&regression, &sizes, numbers.data());
        tied_place_scratch(&scratch, &sizes, scratch_numbers.data());
        tied_reset(&regression, &sizes, nullptr);
    }
    void learn(const RowMajor &Phi, const Eigen::Vector3d &y, double h, double keep)
    {
        const double no_doubt[9] = {};
        rows.assign(Phi.data(), Phi.data() + Phi.size());
        rows.resize(rows.size() + SPARE);
        tied_test(&regression, &sizes, loops, rows.data(), y.data(), no_doubt, &scratch, &fit);
        tied_learn(&regression, &sizes, loops, rows.data(), y.data(), h, keep, &scratch, &fit);
    }
    /* Without a test before: the products are made by tied_learn(). */
    void learn_untested(double h, const Eigen::Vector3d &y)
    {
        scratch.tested = nullptr;
        tied_learn(&regression, &sizes, loops, rows.data(), y.data(), h, 1, &scratch, &fit);
    }
    Eigen::Map<const Eigen::VectorXd> theta(int k) const
    {
        return {regression.theta[k], sizes.size[k]};
    }
};

RowMajor random_rows(int P)
{
    RowMajor Phi(3, P);

    for (int i = 0; i < 3 * P; i++)
        Phi.data()[i] = bed_normal();
    return Phi;
}

Eigen::Vector3d random_y()
{
    return {bed_normal(), bed_normal(), bed_normal()};
}

void expect_close(const Eigen::VectorXd &ours, const Eigen::VectorXd &wanted)
{
    ck_assert_msg((ours - wanted).norm() <= 1e-9 * (1 + wanted.norm()), "off by %g of %g",
                  (ours - wanted).norm(), wanted.norm());
}

START_TEST(all_sizes_are_the_batch_posterior)
{
    bed_seed();
    for (int n = 1; n <= 8; n++) {
        Regression ours(n);
        BatchPosterior batch;
        int P = ours.sizes.size[2];
        for (int s = 0; s < 60; s++) {
            double h = s % 3 ? 1 : bed_uniform(0, 1);
            RowMajor Phi = random_rows(P);
            Eigen::Vector3d y = random_y();
            ours.learn(Phi, y, h, 1);
            batch.add(Phi, y, h);
            for (int k = 0; k < DESIGN_SIZES && s % 7 == 0; k++)
                expect_close(ours.theta(k), batch.mean(ours.sizes.size[k]));
        }
        for (int k = 0; k < DESIGN_SIZES; k++) {
            RowMajor query = random_rows(P);
            Eigen::MatrixXd part = query.leftCols(ours.sizes.size[k]);
            double covariance[9] = {};
            ours.rows.assign(query.data(), query.data() + query.size());
            ours.rows.resize(ours.rows.size() + SPARE);
            ours.regression.chosen = k;
            tied_add_doubt(&ours.regression, &ours.sizes, ours.loops, ours.rows.data(),
                           &ours.scratch, covariance);
            Eigen::Matrix3d wanted =
                part * batch.information(ours.sizes.size[k]).llt().solve(part.transpose());
            for (int i = 0; i < 9; i++)
                ck_assert_double_eq_tol(covariance[i], wanted(i / 3, i % 3), 1e-9);
        }
    }
}
END_TEST

/* What a test leaves behind for the learning after it changes no bit. */
START_TEST(learning_without_a_test_is_the_same)
{
    bed_seed();
    Regression one(5);
    Regression other(5);
    for (int s = 0; s < 20; s++) {
        RowMajor Phi = random_rows(one.sizes.size[2]);
        Eigen::Vector3d y = random_y();
        one.learn(Phi, y, 0.7, 1);
        other.rows = one.rows;
        other.fit = one.fit;
        other.learn_untested(0.7, y);
    }
    ck_assert(one.numbers == other.numbers);
}
END_TEST

/* Evidence fades by a thousandth a sample; the batch formula knows no fading, so it is undone. */
START_TEST(evidence_is_the_log_marginal_likelihood)
{
    bed_seed();
    Regression ours(3);
    BatchPosterior batch;
    double before[DESIGN_SIZES] = {};
    double sum[DESIGN_SIZES] = {};
    for (int s = 0; s < 40; s++) {
        RowMajor Phi = random_rows(ours.sizes.size[2]);
        Eigen::Vector3d y = random_y();
        ours.learn(Phi, y, 1, 1);
        batch.add(Phi, y, 1);
        for (int k = 0; k < DESIGN_SIZES; k++) {
            sum[k] += ours.regression.evidence[k] - 0.999 * before[k];
            before[k] = ours.regression.evidence[k];
            ck_assert_double_eq_tol(sum[k], batch.log_marginal_likelihood(ours.sizes.size[k]),
                                    1e-8);
        }
    }
}
END_TEST

/* A doubt widens what a sample may differ by, and is no evidence for anything. */
START_TEST(a_doubt_widens_the_test_alone)
{
    bed_seed();
    Regression ours(3);
    double doubt[9] = {4, 1, 0, 1, 3, 0.5, 0, 0.5, 2};
    RowMajor Phi = random_rows(ours.sizes.size[2]);
    Eigen::Vector3d y = random_y();
    ours.rows.assign(Phi.data(), Phi.data() + Phi.size());
    ours.rows.resize(ours.rows.size() + SPARE);
    tied_test(&ours.regression, &ours.sizes, ours.loops, ours.rows.data(), y.data(), doubt,
              &ours.scratch, &ours.fit);
    for (int k = 0; k < DESIGN_SIZES; k++) {
        Eigen::MatrixXd part = Phi.leftCols(ours.sizes.size[k]);
        Eigen::Matrix3d S = Eigen::Matrix3d::Identity() + part * part.transpose();
        Eigen::Matrix3d wide = S + Eigen::Map<Eigen::Matrix3d>(doubt);
        auto log_density = [&](const Eigen::Matrix3d &M) {
            return -0.5 * y.dot(M.inverse() * y) - 0.5 * std::log(M.determinant());
        };
        ck_assert_double_eq_tol(ours.fit.distance[k], y.dot(wide.inverse() * y), 1e-9);
        ck_assert_double_eq_tol(ours.fit.log_density[k], log_density(wide), 1e-9);
        ck_assert_double_eq_tol(ours.fit.log_evidence[k], log_density(S), 1e-9);
    }
    tied_learn(&ours.regression, &ours.sizes, ours.loops, ours.rows.data(), y.data(), 1, 1,
               &ours.scratch, &ours.fit);
    for (int k = 0; k < DESIGN_SIZES; k++)
        ck_assert_double_eq(ours.regression.evidence[k], ours.fit.log_evidence[k]);
}
END_TEST

/* With forgetting C is keep C + Phi' Phi + P (1 - keep) e e' for the coefficient in turn. */
START_TEST(forgetting_is_as_it_is_written)
{
    bed_seed();
    for (int n = 1; n <= 5; n++) {
        Regression ours(n);
        int P = ours.sizes.size[2];
        Eigen::MatrixXd C = Eigen::MatrixXd::Identity(P, P);
        Eigen::VectorXd b = Eigen::VectorXd::Zero(P);
        for (int s = 0; s < 200; s++) {
            double keep = s % 4 ? 0.98 : 1;
            double h = bed_uniform(0, 1);
            int turn = (int)ours.regression.turn;
            RowMajor Phi = random_rows(P);
            Eigen::Vector3d y = random_y();
            ours.learn(Phi, y, h, keep);
            C = keep * C + h * Phi.transpose() * Phi;
            b = keep * b + h * Phi.transpose() * y;
            C(turn, turn) += P * (1 - keep);
        }
        for (int k = 0; k < DESIGN_SIZES; k++) {
            int size = ours.sizes.size[k];
            expect_close(ours.theta(k), C.topLeftCorner(size, size).llt().solve(b.head(size)));
        }
    }
}
END_TEST

/* The same sample again and again says nothing of most directions: their prior holds. */
START_TEST(a_million_samples_leave_it_bounded)
{
    bed_seed();
    Regression ours(2);
    int P = ours.sizes.size[2];
    RowMajor Phi = random_rows(P);
    for (long s = 0; s < 1000000; s++) {
        Eigen::Vector3d y = random_y();
        if (s % 4096 == 0)
            Phi = 10 * random_rows(P) * (s % 8192 ? 1 : 0);
        ours.learn(Phi, y, 1, 1 - 1 / 2000.0);
    }
    for (int i = 0; i < P; i++) {
        double diagonal = ours.regression.G[whitener_row(i) + (size_t)i];
        ck_assert_double_gt(diagonal, 0);
        ck_assert_double_lt(diagonal, 1.5); /* of a prior whose own is 1 */
    }
    for (int k = 0; k < DESIGN_SIZES; k++) {
        ck_assert_double_lt(ours.theta(k).norm(), 10);
        ck_assert(std::isfinite(ours.regression.evidence[k]));
        ck_assert_double_lt(std::fabs(ours.regression.evidence[k]), 1e6);
    }
}
END_TEST

} /* namespace */

int main()
{
    const TTest *const tests[] = {
        all_sizes_are_the_batch_posterior,       learning_without_a_test_is_the_same,
        evidence_is_the_log_marginal_likelihood, a_doubt_widens_the_test_alone,
        forgetting_is_as_it_is_written,          a_million_samples_leave_it_bounded,
    };
    return SUITE_RUN("tied", tests);
}
