#include "daemon/control/kinematics/taskspace.h"

#include <Eigen/Dense>

namespace
{

/* Sizes are bounded at compile time, so that Eigen keeps everything on the stack. */
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, MAX_JOINTS, 1>;
using Matrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, MAX_JOINTS, MAX_JOINTS>;

struct Inverse {
    Matrix pinv; /* joints x rows */
    double smallest;
};

/* Moore-Penrose inverse through the SVD; below the threshold the damped one of eq. 8, whose
 * singular values are s / (s^2 + lambda^2), lambda^2 from eq. 9. */
Inverse invert(const Matrix &scaled, double threshold, double damping_max)
{
    Eigen::JacobiSVD<Matrix> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const auto &s = svd.singularValues();
    const Eigen::Index rank = s.size();
    const double smallest = scaled.rows() <= scaled.cols() ? s(rank - 1) : 0.0;
    double lambda2 = 0;
    if (smallest < threshold) {
        const double share = smallest / threshold;
        lambda2 = (1 - share * share) * damping_max * damping_max;
    }
    Vector gain(rank);
    for (Eigen::Index i = 0; i < rank; i++) {
        const double denominator = s(i) * s(i) + lambda2;
        gain(i) = denominator > 0 ? s(i) / denominator : 0.0;
    }
    return {svd.matrixV().leftCols(rank) * gain.asDiagonal() *
                svd.matrixU().leftCols(rank).transpose(),
            smallest};
}

/* The joint that is farthest beyond what it may do; -1 = none. A joint that is held at its bound
 * is there but for rounding. */
int worst_offender(const struct taskspace &taskspace, const Eigen::Ref<const Vector> &velocity)
{
    double most = 1e-9;
    int worst = -1;

    for (int i = 0; i < taskspace.n_joints; i++) {
        const double beyond =
            std::max(velocity(i) - taskspace.fastest[i], taskspace.slowest[i] - velocity(i));
        if (beyond > most) {
            most = beyond;
            worst = i;
        }
    }
    return worst;
}

} // namespace

void taskspace_centring_gradient(const struct taskspace *taskspace, const double *q,
                                 double *gradient)
{
    for (int i = 0; i < taskspace->n_joints; i++) {
        const double half = 0.5 * (taskspace->q_max[i] - taskspace->q_min[i]);
        gradient[i] = 2.0 / taskspace->n_joints * (q[i] - taskspace->posture[i]) / (half * half);
    }
}

double taskspace_velocity(const struct taskspace *taskspace, const double *jacobian,
                          const double *x_velocity, const double *q, double *q_velocity)
{
    const int n = taskspace->n_joints;
    Eigen::Map<const Vector> scale(taskspace->scale, taskspace->n_outputs);
    Matrix scaled =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            jacobian, taskspace->n_outputs, n);
    scaled = scale.cwiseInverse().asDiagonal() * scaled;
    Vector wanted = Eigen::Map<const Vector>(x_velocity, taskspace->n_outputs).cwiseQuotient(scale);
    Vector secondary(n);
    taskspace_centring_gradient(taskspace, q, secondary.data());
    secondary *= -taskspace->secondary_gain;

    Eigen::Map<Vector> velocity(q_velocity, n);
    Vector bound = Vector::Zero(n); /* of the joints that are held to one */
    double smallest = 0;
    for (int held = 0; held <= n; held++) {
        const Inverse inverse = invert(scaled, taskspace->threshold, taskspace->damping_max);
        velocity = bound + inverse.pinv * wanted + secondary - inverse.pinv * (scaled * secondary);
        if (held == 0)
            smallest = inverse.smallest;
        const int joint = worst_offender(*taskspace, velocity);
        if (joint < 0)
            break;
        bound(joint) = velocity(joint) > 0 ? taskspace->fastest[joint] : taskspace->slowest[joint];
        wanted -= scaled.col(joint) * bound(joint);
        scaled.col(joint).setZero();
        secondary(joint) = 0;
    }
    return smallest;
}
