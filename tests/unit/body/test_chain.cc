/* The chain of screws against a plain product of Rodrigues' matrices in long double, and its
 * derivatives against differences of that product. */
#include <Eigen/Core>
#include <cmath>

#include "learner/body/chain/chain.h"
#include "learner/body/chain/vec3.h"
/* After the C++ headers: Check takes the word `fail`. */
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

namespace
{

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

Vector vector_of(const double *v)
{
    return Eigen::Map<const Eigen::Vector3d>(v).cast<Real>();
}

Matrix rodrigues(const Vector &w, Real angle)
{
    Matrix K;

    K << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    return Matrix::Identity() + std::sin(angle) * K + (1 - std::cos(angle)) * K * K;
}

struct Pose {
    Matrix R;
    Vector p;
};

/* From the tip inwards, as p(q) = t_1 + E_1 (t_2 + E_2 (...)) is written: not as chain.c does it.
 */
Pose pose_of(const chain &chain, const Vector *axes, const Vector *offsets, const double *q)
{
    Pose pose = {Matrix::Identity(), Vector::Zero()};

    for (int i = chain.n - 1; i >= 0; i--) {
        Vector w = axes[i].normalized();
        Real moved = Real(q[i]) - chain.middle[i];
        if (chain.slides[i]) {
            pose.p += moved * w;
        } else {
            Matrix E = rodrigues(w, moved);
            pose.p = E * pose.p;
            pose.R = E * pose.R;
        }
        pose.p += offsets[i];
    }
    return pose;
}

struct Parts {
    Vector axes[CHAIN_MAX_JOINTS], offsets[CHAIN_MAX_JOINTS];

    explicit Parts(const chain &chain)
    {
        for (int i = 0; i < chain.n; i++) {
            axes[i] = vector_of(chain.axis[i]);
            offsets[i] = vector_of(chain.offset[i]);
        }
    }
    Real &unknown(int n, int k)
    {
        return k < 3 * n ? axes[k / 3][k % 3] : offsets[k / 3 - n][k % 3];
    }
};

/* A chain with sliding joints among the others, at random joints, with a tip. */
struct Scene {
    chain arm;
    double q[CHAIN_MAX_JOINTS];
    double tip[3];
    chain_pose pose;
    double tip_in_base[3];

    explicit Scene(int n)
    {
        struct body body = made_up_arm(n, false);
        arm = body.chain;
        for (int i = 0; i < n; i++)
            arm.slides[i] = bed_uniform(0, 1) < 0.25;
        random_joints(&body, q);
        for (double &t : tip)
            t = 0.2 * bed_normal();
        chain_at(&arm, q, &pose);
        mat3_apply(pose.turn[n], tip, tip_in_base);
        vec3_add(1, pose.p, tip_in_base);
    }
    Vector plain_tip(const Parts &parts, const double *joints) const
    {
        Pose plain = pose_of(arm, parts.axes, parts.offsets, joints);
        return plain.p + plain.R * vector_of(tip);
    }
};

const Real step = 1e-6L;
const double close = 1e-9; /* of differences of numbers near 1, in long double */

void expect_column(const double *matrix, int columns, int column, const Vector &wanted,
                   const char *what)
{
    for (int row = 0; row < 3; row++)
        ck_assert_msg(std::fabs(matrix[row * columns + column] - double(wanted[row])) < close,
                      "%s, column %d: %.12g instead of %.12g", what, column,
                      matrix[row * columns + column], double(wanted[row]));
}

START_TEST(a_pose_is_the_plain_product)
{
    bed_seed();
    for (int n = 1; n <= CHAIN_MAX_JOINTS; n++)
        for (int k = 0; k < 20; k++) {
            Scene scene(n);
            Parts parts(scene.arm);
            Pose plain = pose_of(scene.arm, parts.axes, parts.offsets, scene.q);
            for (int i = 0; i < 3; i++)
                ck_assert_double_eq_tol(scene.pose.p[i], double(plain.p[i]), 1e-14);
            for (int i = 0; i < 9; i++)
                ck_assert_double_eq_tol(scene.pose.turn[n][i], double(plain.R(i / 3, i % 3)),
                                        1e-14);
        }
}
END_TEST

START_TEST(the_jacobian_is_that_of_the_plain_product)
{
    bed_seed();
    for (int n = 1; n <= CHAIN_MAX_JOINTS; n++) {
        Scene scene(n);
        Parts parts(scene.arm);
        double jacobian[3 * CHAIN_MAX_JOINTS];
        chain_jacobian(&scene.arm, &scene.pose, scene.tip_in_base, jacobian);
        for (int i = 0; i < n; i++) {
            double q[CHAIN_MAX_JOINTS];
            std::copy(scene.q, scene.q + n, q);
            q[i] = scene.q[i] + double(step);
            Vector ahead = scene.plain_tip(parts, q);
            Real apart = q[i];
            q[i] = scene.q[i] - double(step);
            apart -= q[i];
            expect_column(jacobian, n, i, (ahead - scene.plain_tip(parts, q)) / apart,
                          "d tip / d q");
        }
    }
}
END_TEST

START_TEST(the_slope_is_that_of_the_plain_product)
{
    bed_seed();
    for (int n = 1; n <= CHAIN_MAX_JOINTS; n++) {
        Scene scene(n);
        double slope[3 * CHAIN_MAX_UNKNOWNS];
        chain_slope(&scene.arm, &scene.pose, scene.tip_in_base, slope);
        for (int k = 0; k < 6 * n; k++) {
            Parts ahead(scene.arm);
            Parts behind(scene.arm);
            ahead.unknown(n, k) += step;
            behind.unknown(n, k) -= step;
            expect_column(slope, 6 * n, k,
                          (scene.plain_tip(ahead, scene.q) - scene.plain_tip(behind, scene.q)) /
                              (2 * step),
                          "d tip / d unknown");
        }
    }
}
END_TEST

} /* namespace */

int main()
{
    const TTest *const tests[] = {
        a_pose_is_the_plain_product,
        the_jacobian_is_that_of_the_plain_product,
        the_slope_is_that_of_the_plain_product,
    };
    return SUITE_RUN("chain", tests);
}
