/* The recursive mixture that the benches measure against, held against the textbook: the same
 * growth decisions, solutions and Jacobians. */
#include <cmath>
#include <cstdio>

#include "tools/bench/reference/recursive_imle.h"
/* After the C++ headers: Check takes the word `fail`. */
#include "bed.h"
#include "tests/unit/suite.h"

namespace
{

/* Rank-1 updates and raw sums round differently; what they compute is the same. */
const double tolerance = 1e-6;

struct Case {
    int d, D;
    double alpha;
    bool infinite_psi;
    int n_outliers;
    int em_pred_iterations;
};

const Case cases[] = {
    {1, 1, 0.999, false, 1, 2}, {2, 3, 1.0, true, 0, 10},   {4, 3, 0.999, true, 1, 2},
    {7, 3, 0.999, false, 1, 2}, {7, 3, 0.999, true, 1, 10},
};

oracle::Parameters parameters_of(const Case &k)
{
    oracle::Parameters p;
    p.d = k.d;
    p.D = k.D;
    p.psi0 = Eigen::VectorXd::LinSpaced(k.D, 0.01, 0.02);
    p.sigma0 = Eigen::VectorXd::LinSpaced(k.d, 0.1, 0.2);
    p.alpha = k.alpha;
    p.w_sigma = p.w_Sigma = p.w_Psi = std::pow(2, k.d);
    p.w_psi = 2 * k.D;
    if (k.infinite_psi)
        p.w_psi = p.w_Psi = INFINITY;
    p.n_outliers = k.n_outliers;
    p.em_pred_iterations = k.em_pred_iterations;
    p.floor = 0;
    p.skip = 1e-9; /* both skip the same experts */
    return p;
}

/* A bent surface with two sheets. */
void sample(Eigen::VectorXd &z, Eigen::VectorXd &x)
{
    int sheet = bed_uniform(0, 1) < 0.5;
    for (Eigen::Index i = 0; i < z.size(); i++)
        z(i) = bed_uniform(-1, 1);
    for (Eigen::Index i = 0; i < x.size(); i++)
        x(i) = std::sin(2 * z(i % z.size()) + double(i)) + 0.3 * z.sum() + 1.5 * sheet +
               0.05 * bed_normal();
}

void assert_close(double ours, double theirs, double scale, const char *what)
{
    ck_assert_msg(std::fabs(ours - theirs) <= tolerance * (scale + std::fabs(theirs)),
                  "%s: recursive %.15g, textbook %.15g", what, ours, theirs);
}

void compare(const oracle::Solution &ours, const oracle::Solution &theirs)
{
    assert_close(ours.weight, theirs.weight, 1e-6, "weight");
    for (Eigen::Index i = 0; i < theirs.value.size(); i++) {
        assert_close(ours.value(i), theirs.value(i), 1, "value");
        assert_close(ours.variance(i), theirs.variance(i), 1e-6, "variance");
        for (Eigen::Index c = 0; c < theirs.jacobian.cols(); c++)
            assert_close(ours.jacobian(i, c), theirs.jacobian(i, c), 10, "Jacobian");
    }
}

void run_case(const Case &k)
{
    oracle::RecursiveImle ours(parameters_of(k));
    oracle::TextbookImle theirs(parameters_of(k));
    Eigen::VectorXd z(k.d), x(k.D);
    size_t most = 0;
    for (int n = 0; n < 600; n++) {
        sample(z, x);
        ck_assert_msg(ours.update(z.data(), x.data()) == theirs.update(z, x),
                      "d=%d, D=%d, sample %d: another growth decision", k.d, k.D, n);
        sample(z, x);
        if (n % 20 != 19)
            continue;
        std::vector<oracle::Solution> expected = theirs.predict(z);
        const std::vector<oracle::Solution> &solutions = ours.predict(z.data());
        ck_assert_uint_eq(solutions.size(), expected.size());
        most = std::max(most, solutions.size());
        for (size_t s = 0; s < solutions.size(); s++)
            compare(solutions[s], expected[s]);
    }
    ck_assert_int_gt(ours.experts(), 1);
    ck_assert_uint_gt(most, 1);
    printf("d=%d D=%d: %d experts, up to %zu solutions\n", k.d, k.D, ours.experts(), most);
}

START_TEST(same_as_textbook)
{
    bed_seed();
    for (const Case &k : cases)
        run_case(k);
}
END_TEST

} /* namespace */

int main()
{
    const TTest *const tests[] = {same_as_textbook};
    return SUITE_RUN("recursive mixture against textbook", tests);
}
