#include "learner/finder/problem.h"

#include "learner/body/chain/vec3.h"

#include <ceres/ceres.h>
#include <cmath>
#include <glog/logging.h>

namespace finder
{

namespace
{

double *unknown_of(eyes &e, int k)
{
    return k < 3 ? &e.neck[k] : k < 6 ? &e.eye[k - 3] : k < 8 ? &e.tilt[k - 6] : &e.law[k - 7];
}

/* d (dP / dx) / d unknown k, times u. false where the eyes see nothing on one side of it. */
bool change_of_view(const eyes &e, int k, const Eigen::Vector3d &x, const double *u, double *change)
{
    const double step = 1e-6;
    eyes moved[2] = {e, e};
    eyes_view at[2];

    for (int side = 0; side < 2; side++) {
        *unknown_of(moved[side], k) += side == 0 ? -step : step;
        if (!eyes_point(&moved[side], x.data(), &at[side]))
            return false;
    }
    for (int i = 0; i < 3; i++) {
        change[i] = 0;
        for (int c = 0; c < 3; c++)
            change[i] += (at[1].by_x[3 * i + c] - at[0].by_x[3 * i + c]) / (2 * step) * u[c];
    }
    return true;
}

/* r = M (tip - P(x)), M = d x / d place over the noise. Its derivative by the eyes has a part from
 * M: d r = -M (dP + dJ u), u = J^-1 (tip - P), where J = dP / dx changes with the eyes, too. */
bool seen_residual(const Data &data, const struct body &body, const Eigen::Vector3d &tip,
                   const Eigen::Vector3d &x, double *left, double *white, double *by_eyes)
{
    eyes_view view;
    double inverse[9];
    double apart[3];
    double u[3];

    /* Where the eyes see nothing is not approached: derivatives are wanted on both sides. */
    double d = (x[2] - body.eyes.disparity_middle) / body.eyes.disparity_unit;
    const double *law = body.eyes.law;
    if (law[0] + d * (law[1] + d * law[2]) < 0.02 || !eyes_point(&body.eyes, x.data(), &view))
        return false;
    mat3_invert(view.by_x, inverse);
    for (int i = 0; i < 3; i++)
        apart[i] = tip[i] - view.point[i];
    mat3_apply(inverse, apart, u);
    for (int i = 0; i < 3; i++)
        left[i] = u[i] / data.noise[i];
    for (int i = 0; i < 9; i++) {
        white[i] = inverse[i] / data.noise[i / 3];
        if (!std::isfinite(white[i]))
            return false;
    }
    for (int k = 0; by_eyes && k < EYES_UNKNOWNS; k++) {
        double change[3];
        double turned[3];
        if (!change_of_view(body.eyes, k, x, u, change))
            return false;
        for (int i = 0; i < 3; i++)
            change[i] += view.by_unknown[i * EYES_UNKNOWNS + k];
        mat3_apply(white, change, turned);
        for (int i = 0; i < 3; i++)
            by_eyes[i * EYES_UNKNOWNS + k] = -turned[i];
    }
    return true;
}

} // namespace

bool residual(const Data &data, const struct body &body, const Eigen::Vector3d &tip,
              const Sample &sample, double *left, double *by_unknowns, double *by_tip)
{
    chain_pose pose;
    double slope[3 * CHAIN_MAX_UNKNOWNS];
    double by_eyes[3 * EYES_UNKNOWNS] = {};
    double white[9] = {1 / data.noise[0], 0, 0, 0, 1 / data.noise[1], 0, 0, 0, 1 / data.noise[2]};
    double turned[3];
    int n_chain = 6 * data.n;
    int n = data.unknowns();

    chain_at(&body.chain, sample.z, &pose);
    const double *R = pose.turn[data.n];
    mat3_apply(R, tip.data(), turned);
    vec3_add(1, pose.p, turned);
    Eigen::Vector3d place(turned);
    if (body.sees) {
        if (!seen_residual(data, body, place, sample.x, left, white,
                           by_unknowns ? by_eyes : nullptr))
            return false;
    } else {
        for (int i = 0; i < 3; i++)
            left[i] = (place[i] - sample.x[i]) * white[4 * i];
    }
    if (by_tip)
        mat3_multiply(white, R, by_tip);
    if (!by_unknowns)
        return true;
    chain_slope(&body.chain, &pose, place.data(), slope);
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < n_chain; k++)
            by_unknowns[r * n + k] = white[3 * r] * slope[k] +
                                     white[3 * r + 1] * slope[n_chain + k] +
                                     white[3 * r + 2] * slope[2 * n_chain + k];
        for (int k = n_chain; k < n; k++)
            by_unknowns[r * n + k] = by_eyes[r * EYES_UNKNOWNS + k - n_chain];
    }
    return true;
}

Eigen::VectorXd unknowns_of(const Data &data, const Candidate &candidate)
{
    const struct chain &chain = candidate.body.chain;
    const eyes &e = candidate.body.eyes;
    Eigen::VectorXd v(data.unknowns());

    for (int i = 0; i < data.n; i++) {
        v.segment<3>(3 * i) = Eigen::Map<const Eigen::Vector3d>(chain.axis[i]);
        v.segment<3>(3 * (data.n + i)) = Eigen::Map<const Eigen::Vector3d>(chain.offset[i]);
    }
    if (data.settings->sees)
        v.tail<EYES_UNKNOWNS>() << e.neck[0], e.neck[1], e.neck[2], e.eye[0], e.eye[1], e.eye[2],
            e.tilt[0], e.tilt[1], e.law[1], e.law[2];
    return v;
}

/* The axes keep their length: chains are evaluated with unit axes, the solver's are free. */
void take_unknowns(const Data &data, const Eigen::VectorXd &v, Candidate &candidate)
{
    struct chain &chain = candidate.body.chain;
    eyes &e = candidate.body.eyes;

    for (int i = 0; i < data.n; i++) {
        Eigen::Map<Eigen::Vector3d>(chain.axis[i]) = v.segment<3>(3 * i).normalized();
        Eigen::Map<Eigen::Vector3d>(chain.offset[i]) = v.segment<3>(3 * (data.n + i));
    }
    if (!data.settings->sees)
        return;
    const Eigen::VectorXd seen = v.tail<EYES_UNKNOWNS>();
    for (int i = 0; i < 3; i++) {
        e.neck[i] = seen[i];
        e.eye[i] = seen[3 + i];
    }
    for (int i = 0; i < 2; i++) {
        e.tilt[i] = seen[6 + i];
        e.law[1 + i] = seen[8 + i];
    }
}

namespace
{

class SampleCost : public ceres::CostFunction
{
public:
    SampleCost(const Data &data, const Candidate &like, const Sample &sample)
        : data_(data), like_(like), sample_(sample)
    {
        set_num_residuals(3);
        mutable_parameter_block_sizes()->push_back(data.unknowns());
        mutable_parameter_block_sizes()->push_back(3);
    }

    bool Evaluate(double const *const *parameters, double *left, double **jacobians) const override
    {
        const int n = data_.unknowns();
        Eigen::Map<const Eigen::VectorXd> v(parameters[0], n);
        Candidate candidate = like_;
        take_unknowns(data_, v, candidate);
        double *by_unknowns = jacobians ? jacobians[0] : nullptr;
        double *by_tip = jacobians ? jacobians[1] : nullptr;
        if (!residual(data_, candidate.body, Eigen::Map<const Eigen::Vector3d>(parameters[1]),
                      sample_, left, by_unknowns, by_tip))
            return false;
        for (int i = 0; by_unknowns && i < data_.n; i++) {
            double shorter = 1 / v.segment<3>(3 * i).norm();
            for (int r = 0; r < 3; r++)
                for (int k = 0; k < 3; k++)
                    by_unknowns[r * n + 3 * i + k] *= shorter;
        }
        return true;
    }

private:
    const Data &data_;
    const Candidate &like_;
    const Sample &sample_;
};

/* Weak priors: lengths of axes near 1, offsets and eyes not far from what they began with. */
class PriorCost : public ceres::CostFunction
{
public:
    PriorCost(const Data &data, Eigen::VectorXd begin) : data_(data), begin_(std::move(begin))
    {
        set_num_residuals(data.n + data.unknowns() - 3 * data.n);
        mutable_parameter_block_sizes()->push_back(data.unknowns());
    }

    bool Evaluate(double const *const *parameters, double *left, double **jacobians) const override
    {
        const int n = data_.unknowns();
        Eigen::Map<const Eigen::VectorXd> v(parameters[0], n);
        double *J = jacobians ? jacobians[0] : nullptr;
        if (J)
            std::fill(J, J + (ptrdiff_t)num_residuals() * n, 0.0);
        for (int i = 0; i < data_.n; i++) {
            double length = v.segment<3>(3 * i).norm();
            left[i] = (length - 1) / prior_axis;
            for (int k = 0; J && k < 3; k++)
                J[i * n + 3 * i + k] = v[3 * i + k] / length / prior_axis;
        }
        for (int k = 3 * data_.n; k < n; k++) {
            int row = k - 2 * data_.n;
            double sd = k < 6 * data_.n ? prior_offset : prior_eye;
            double middle = k < 6 * data_.n ? 0 : begin_[k];
            left[row] = (v[k] - middle) / sd;
            if (J)
                J[row * n + k] = 1 / sd;
        }
        return true;
    }

private:
    const Data &data_;
    Eigen::VectorXd begin_;
};

} // namespace

void solve(const Data &data, int most_iterations, bool robust, Candidate &candidate)
{
    Eigen::VectorXd v = unknowns_of(data, candidate);
    Eigen::VectorXd prior_of_eyes = v;
    const Candidate like = candidate;
    ceres::Problem problem;
    ceres::Solver::Options options;
    ceres::Solver::Summary summary;

    if (data.settings->sees)
        prior_of_eyes.tail<EYES_UNKNOWNS>() << 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0;
    problem.AddResidualBlock(new PriorCost(data, prior_of_eyes), nullptr, v.data());
    for (const Sample &sample : data.samples)
        if (!sample.apart && !sample.gross)
            problem.AddResidualBlock(new SampleCost(data, like, sample),
                                     robust ? new ceres::CauchyLoss(3) : nullptr, v.data(),
                                     candidate.tips[(size_t)sample.context].data());
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = most_iterations;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.function_tolerance = 1e-7;
    options.parameter_tolerance = 1e-10;
    options.max_num_consecutive_invalid_steps = 20;
    FLAGS_minloglevel = google::GLOG_FATAL; /* a start that fails is none of the user's business */
    ceres::Solve(options, &problem, &summary);
    take_unknowns(data, v, candidate);
    candidate.cost = summary.IsSolutionUsable() ? summary.final_cost : INFINITY;
}

} // namespace finder
