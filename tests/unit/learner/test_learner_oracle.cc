/* The daemon's linear learner against the textbook, sample by sample, on random streams: the same
 * growth decisions, predictions, solutions and Jacobians. */
#include <cmath>
#include <cstdio>

#include "tools/bench/reference/parameters_of.h"
#include "tools/bench/reference/textbook_imle.h"
/* After the C++ headers: Check takes the word `fail`. */
#include "bed.h"
#include "tests/unit/suite.h"

namespace
{

/* The textbook's raw sums lose digits that the daemon's centred form keeps; what is left of
 * agreement on these short streams of numbers near 1 is far better than this. */
const double tolerance = 1e-6;

struct Case {
    int d, D;
    double alpha, w_nu;
    bool infinite_psi;
    int n_outliers;
};

const Case cases[] = {
    {1, 1, 0.999, 0, false, 1},  {2, 1, 0.99, 0, false, 0}, {3, 2, 1.0, 0, true, 1},
    {2, 3, 0.95, 0.5, false, 2}, {4, 3, 0.999, 0, true, 1}, {7, 3, 0.999, 0, false, 1},
    {1, 2, 0.9, 1.0, false, 1},
};

learner_config config_of(const Case &k)
{
    learner_config c = learner_config_default(k.d, k.D);
    c.alpha = k.alpha;
    c.prior_nu = k.w_nu;
    c.n_outliers = k.n_outliers;
    c.capacity = 400;
    c.skip = 1e-9;
    c.prior_floor = 1e-9; /* the ridge's floor is the daemon's own: kept out of the comparison */
    for (int i = 0; i < k.d; i++)
        c.sigma0[i] = 0.1 * (1 + 0.2 * i);
    for (int i = 0; i < k.D; i++)
        c.psi0[i] = 0.01 * (1 + 0.3 * i);
    if (k.infinite_psi)
        c.prior_psi = c.hyper_psi = INFINITY;
    return c;
}

/* A bent surface with two sheets, and a few points that lie on neither. */
void sample(int d, int D, Eigen::VectorXd &z, Eigen::VectorXd &x)
{
    int sheet = bed_uniform(0, 1) < 0.5;
    bool stray = bed_uniform(0, 1) < 0.01;
    for (int i = 0; i < d; i++)
        z(i) = bed_uniform(-1, 1);
    for (int i = 0; i < D; i++) {
        x(i) = std::sin(2 * z(i % d) + i) + 0.3 * z.sum() + 1.5 * sheet + 0.05 * bed_normal();
        if (stray)
            x(i) += bed_uniform(-5, 5);
    }
}

void assert_close(double ours, double theirs, double scale, const char *what)
{
    ck_assert_msg(std::fabs(ours - theirs) <= tolerance * (scale + std::fabs(theirs)),
                  "%s: daemon %.15g, textbook %.15g", what, ours, theirs);
}

void compare(const learner_solution &ours, const oracle::Solution &theirs, int d, int D)
{
    // a share of one, of which what is skipped may take M e^-20: 1e-8 in all
    assert_close(ours.weight, theirs.weight, 0.01, "weight");
    for (int i = 0; i < D; i++) {
        assert_close(ours.value[i], theirs.value(i), 1, "value");
        assert_close(ours.variance[i], theirs.variance(i), 1e-6, "variance");
        for (int c = 0; c < d; c++)
            assert_close(ours.jacobian[i * d + c], theirs.jacobian(i, c), 10, "Jacobian");
    }
}

void compare_query(learner *ours, const oracle::TextbookImle &theirs, const Eigen::VectorXd &z,
                   int d, int D)
{
    static learner_prediction prediction;
    learner_solution single;
    std::vector<oracle::Solution> solutions = theirs.predict(z);
    ck_assert_int_eq(learner_predict(ours, z.data(), &prediction), int(solutions.size()));
    for (size_t k = 0; k < solutions.size(); k++)
        compare(prediction.solution[k], solutions[k], d, D);
    ck_assert_int_eq(learner_predict_single(ours, z.data(), &single), 1);
    compare(single, theirs.predict_single(z), d, D);
}

void run_case(const Case &k)
{
    learner_config config = config_of(k);
    learner *ours = bed_create(&config);
    oracle::TextbookImle theirs(oracle::parameters_of(config));
    Eigen::VectorXd z(k.d), x(k.D);
    for (int n = 0; n < 600; n++) {
        sample(k.d, k.D, z, x);
        oracle::Result result = theirs.update(z, x);
        int expected = result == oracle::Result::updated ? LEARNER_UPDATED
                       : result == oracle::Result::born  ? LEARNER_BORN
                                                         : LEARNER_OUTLIER;
        ck_assert_msg(learner_update(ours, z.data(), x.data()) == expected,
                      "d=%d, D=%d, sample %d: another growth decision", k.d, k.D, n);
        ck_assert_int_eq(learner_get_statistics(ours).experts, theirs.experts());
        sample(k.d, k.D, z, x);
        if (n % 20 == 19 && theirs.experts() > 0)
            compare_query(ours, theirs, z, k.d, k.D);
    }
    printf("d=%d D=%d: %d experts\n", k.d, k.D, theirs.experts());
    bed_clean();
}

START_TEST(same_as_textbook)
{
    bed_seed();
    for (const Case &k : cases)
        run_case(k);
}
END_TEST

/* Experts that take less than `skip` of a sample leave it: the predictions stay near. */
START_TEST(skipping_changes_little)
{
    bed_seed();
    learner_config config = config_of(cases[4]);
    learner_config skipping = config;
    skipping.skip = 1e-6;
    learner *every = bed_create(&config);
    learner *most = bed_create(&skipping);
    Eigen::VectorXd z(4), x(3);
    learner_solution a, b;
    for (int n = 0; n < 3000; n++) {
        sample(4, 3, z, x);
        ck_assert_int_eq(learner_update(every, z.data(), x.data()),
                         learner_update(most, z.data(), x.data()));
        if (!learner_predict_single(every, z.data(), &a))
            continue;
        learner_predict_single(most, z.data(), &b);
        for (int i = 0; i < 3; i++)
            ck_assert_double_eq_tol(a.value[i], b.value[i], 1e-3);
    }
    bed_clean();
}
END_TEST

} /* namespace */

int main()
{
    const TTest *const tests[] = {same_as_textbook, skipping_changes_little};
    return SUITE_RUN("learner against textbook", tests);
}
