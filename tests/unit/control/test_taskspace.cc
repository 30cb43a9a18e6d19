/* The inverse of the task space against an independent reference, near singularities too. */
#include "daemon/control/kinematics/taskspace.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

extern "C" {
#include "fixture.h"
#include "tests/unit/suite.h"
}

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct taskspace settings(int rows, int joints)
{
    struct taskspace t = {};

    t.n_joints = joints;
    t.n_outputs = rows;
    std::fill(t.scale, t.scale + rows, 1.0);
    t.threshold = 0.05;
    t.damping_max = 0.05;
    for (int i = 0; i < joints; i++) {
        t.q_min[i] = -1 - 0.1 * i;
        t.q_max[i] = 1 + 0.2 * i;
        t.slowest[i] = -INFINITY;
        t.fastest[i] = INFINITY;
        t.posture[i] = (t.q_min[i] + t.q_max[i]) / 2;
    }
    return t;
}

MatrixXd random_matrix(struct random_state *random, int rows, int columns)
{
    MatrixXd m(rows, columns);

    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++)
            m(r, c) = random_uniform(random, -1, 1);
    return m;
}

/* Equation 8 word by word, with the normal equations; eq. 9 from eigenvalues of J J'. */
VectorXd reference(const struct taskspace &t, const MatrixXd &jacobian, const VectorXd &x_velocity,
                   const VectorXd &q)
{
    VectorXd scale = Eigen::Map<const VectorXd>(t.scale, t.n_outputs);
    MatrixXd j = scale.cwiseInverse().asDiagonal() * jacobian;
    MatrixXd gram = j * j.transpose();
    double smallest =
        std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<MatrixXd>(gram).eigenvalues()(0)));
    double lambda2 = 0;
    if (smallest < t.threshold)
        lambda2 = (1 - std::pow(smallest / t.threshold, 2)) * t.damping_max * t.damping_max;
    gram.diagonal().array() += lambda2;
    MatrixXd pinv = j.transpose() * gram.inverse();
    VectorXd secondary(t.n_joints);
    for (int i = 0; i < t.n_joints; i++) {
        double a = (t.q_max[i] + t.q_min[i]) / 2;
        secondary(i) = -t.secondary_gain * 2.0 / t.n_joints * (q(i) - a) /
                       ((a - t.q_max[i]) * (a - t.q_max[i]));
    }
    return pinv * x_velocity.cwiseQuotient(scale) +
           (MatrixXd::Identity(t.n_joints, t.n_joints) - pinv * j) * secondary;
}

MatrixXd row_major(const double *from, int rows, int columns)
{
    return Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(from, rows, columns);
}

/* Row-major copy, since that is what the interface takes. */
void flatten(const MatrixXd &m, double *to)
{
    for (int r = 0; r < m.rows(); r++)
        for (int c = 0; c < m.cols(); c++)
            to[r * m.cols() + c] = m(r, c);
}

void compare(const struct taskspace &t, const MatrixXd &jacobian, struct random_state *random)
{
    VectorXd wanted = random_matrix(random, t.n_outputs, 1);
    VectorXd q = random_matrix(random, t.n_joints, 1);
    double flat[MAX_OUTPUTS * MAX_JOINTS], velocity[MAX_JOINTS];

    flatten(jacobian, flat);
    taskspace_velocity(&t, flat, wanted.data(), q.data(), velocity);
    VectorXd expected = reference(t, jacobian, wanted, q);
    double difference = (Eigen::Map<VectorXd>(velocity, t.n_joints) - expected).norm();
    ck_assert_msg(difference < 1e-6 * (1 + expected.norm()), "differs by %g of %g", difference,
                  expected.norm());
}

START_TEST(agrees_with_the_reference)
{
    struct random_state random = fixture_random("test_taskspace");

    for (int round = 0; round < 3000; round++) {
        int rows = 1 + round % 3, joints = 3 + round % 5;
        struct taskspace t = settings(rows, joints);
        t.secondary_gain = 0.1;
        for (int r = 0; r < rows; r++)
            t.scale[r] = random_uniform(&random, 0.1, 10);
        compare(t, random_matrix(&random, rows, joints), &random);
    }
}
END_TEST

/* Rows made nearly parallel, down to exactly so. */
START_TEST(agrees_near_singularities)
{
    struct random_state random = fixture_random("test_taskspace");

    for (int round = 0; round < 3000; round++) {
        struct taskspace t = settings(3, 4);
        MatrixXd j = random_matrix(&random, 3, 4);
        double apart = std::pow(10, random_uniform(&random, -5, 0));
        j.row(2) = j.row(0) + apart * j.row(2);
        compare(t, j, &random);
    }
}
END_TEST

START_TEST(damping_bounds_the_velocity)
{
    struct random_state random = fixture_random("test_taskspace");

    for (int round = 0; round < 2000; round++) {
        struct taskspace t = settings(3, 4);
        MatrixXd j = random_matrix(&random, 3, 4);
        double flat[12], velocity[4];
        VectorXd wanted = random_matrix(&random, 3, 1).normalized();
        j.row(2) = j.row(0) * random_uniform(&random, -1, 1); /* singular */
        flatten(j, flat);
        double smallest = taskspace_velocity(&t, flat, wanted.data(), flat, velocity);
        ck_assert(smallest < 1e-6);
        /* s / (s^2 + lambda^2) is at most 1 / (2 lambda). */
        ck_assert(Eigen::Map<VectorXd>(velocity, 4).norm() <= 1 / (2 * t.damping_max) + 1e-9);
    }
}
END_TEST

START_TEST(far_from_singular_it_is_exact)
{
    struct random_state random = fixture_random("test_taskspace");
    int tested = 0;

    for (int round = 0; round < 1000; round++) {
        struct taskspace t = settings(3, 4);
        MatrixXd j = random_matrix(&random, 3, 4);
        double flat[12], velocity[4];
        VectorXd wanted = random_matrix(&random, 3, 1), q = random_matrix(&random, 4, 1);
        t.secondary_gain = 1;
        flatten(j, flat);
        if (taskspace_velocity(&t, flat, wanted.data(), q.data(), velocity) < t.threshold)
            continue;
        /* The main goal is met whatever the secondary one wants. */
        ck_assert((row_major(flat, 3, 4) * Eigen::Map<VectorXd>(velocity, 4) - wanted).norm() <
                  1e-9);
        tested++;
    }
    ck_assert_int_gt(tested, 500);
}
END_TEST

/* A joint at its limit is held there, and the others still bring what is wanted. */
START_TEST(others_make_up_for_a_joint_at_its_limit)
{
    struct random_state random = fixture_random("test_taskspace");

    for (int trial = 0; trial < 200; trial++) {
        struct taskspace t = settings(3, 7);
        MatrixXd jacobian = random_matrix(&random, 3, 7);
        VectorXd wanted = random_matrix(&random, 3, 1), q = random_matrix(&random, 7, 1);
        double flat[MAX_OUTPUTS * MAX_JOINTS], velocity[MAX_JOINTS];
        int at_limit = trial % 7;

        t.threshold = 1e-6;
        t.slowest[at_limit] = t.fastest[at_limit] = 0;
        t.fastest[(at_limit + 3) % 7] = 0.01;
        flatten(jacobian, flat);
        taskspace_velocity(&t, flat, wanted.data(), q.data(), velocity);
        Eigen::Map<VectorXd> v(velocity, 7);
        ck_assert_double_eq_tol(v(at_limit), 0, 1e-8);
        ck_assert(v((at_limit + 3) % 7) <= 0.01 + 1e-8);
        ck_assert_double_lt((jacobian * v - wanted).norm(), 1e-6);
    }
}
END_TEST

START_TEST(the_gradient_is_that_of_m)
{
    struct taskspace t = settings(3, 4);
    double q[4] = {0.3, -0.5, 0.9, 0.1}, gradient[4];
    auto m = [&](const double *at) {
        double sum = 0;
        for (int i = 0; i < 4; i++) {
            double a = (t.q_max[i] + t.q_min[i]) / 2;
            sum += std::pow((at[i] - a) / (a - t.q_max[i]), 2) / 4;
        }
        return sum;
    };

    taskspace_centring_gradient(&t, q, gradient);
    for (int i = 0; i < 4; i++) {
        double up[4], down[4];
        std::copy(q, q + 4, up);
        std::copy(q, q + 4, down);
        up[i] += 1e-5;
        down[i] -= 1e-5;
        ck_assert_double_eq_tol(gradient[i], (m(up) - m(down)) / 2e-5, 1e-8);
    }
}
END_TEST

} // namespace

int main()
{
    const TTest *const tests[] = {
        agrees_with_the_reference,   agrees_near_singularities,
        damping_bounds_the_velocity, far_from_singular_it_is_exact,
        the_gradient_is_that_of_m,   others_make_up_for_a_joint_at_its_limit};

    return SUITE_RUN("taskspace", tests);
}
