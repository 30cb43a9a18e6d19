#include "learner/finder/judge.h"

#include "learner/body/chain/vec3.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace finder
{

double misfit(const Data &data, const Candidate &candidate, bool apart, double gross)
{
    std::vector<double> squares;

    for (const Sample &sample : data.samples) {
        double left[3];
        if (sample.apart != apart || sample.gross)
            continue;
        if (!residual(data, candidate.body, candidate.tips[(size_t)sample.context], sample, left,
                      nullptr, nullptr))
            return 1e9;
        squares.push_back((left[0] * left[0] + left[1] * left[1] + left[2] * left[2]) / 3);
    }
    if (squares.empty())
        return 1e9;
    std::sort(squares.begin(), squares.end());
    size_t n = squares.size() - (size_t)(gross * (double)squares.size());
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += squares[i];
    return std::sqrt(sum / (double)n);
}

double length_of(const Data &data, const Candidate &candidate)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0;
    double n = (double)data.samples.size();

    for (const Sample &sample : data.samples) {
        double place[3];
        double white[9];
        if (!body_place(&candidate.body, sample.x.data(), place, white))
            return 1;
        sum += Eigen::Vector3d(place);
        squares += Eigen::Vector3d(place).squaredNorm();
    }
    return std::sqrt(std::max(squares / n - (sum / n).squaredNorm(), 1e-12));
}

namespace
{

constexpr double told_rightly = 2.5; /* misfit, in units of the noise told */
constexpr double near = 0.2;         /* rad: neighbours, over which what a chain leaves is smooth */
constexpr int enough_pairs = 40;
constexpr double in_common = 0.25; /* share of the squares */

/* The nearest of the same tool in the joint space; NULL: none is near. */
const Sample *neighbour_of(const Data &data, const Sample &sample)
{
    const Sample *nearest = nullptr;
    double least = near * near;

    for (const Sample &other : data.samples) {
        double distance = 0;
        if (&other == &sample || other.context != sample.context || other.gross)
            continue;
        for (int i = 0; i < data.n && distance < least; i++)
            distance += (sample.z[i] - other.z[i]) * (sample.z[i] - other.z[i]);
        if (distance < least) {
            least = distance;
            nearest = &other;
        }
    }
    return nearest;
}

} // namespace

double noise_factor(const Data &data, const Candidate &candidate)
{
    double of_pairs = 0;
    double squares = 0;
    int pairs = 0;
    double factor = misfit(data, candidate, false, 0);

    if (factor < told_rightly)
        return 1;
    for (const Sample &sample : data.samples) {
        const Sample *other = sample.gross ? nullptr : neighbour_of(data, sample);
        const Eigen::Vector3d &tip = candidate.tips[(size_t)sample.context];
        double here[3];
        double there[3];
        if (!other || !residual(data, candidate.body, tip, sample, here, nullptr, nullptr) ||
            !residual(data, candidate.body, tip, *other, there, nullptr, nullptr))
            continue;
        of_pairs += vec3_dot(here, there);
        squares += (vec3_dot(here, here) + vec3_dot(there, there)) / 2;
        pairs++;
    }
    return pairs >= enough_pairs && of_pairs < in_common * squares ? factor : 1;
}

namespace
{

/* Where no sample is, ten times the doubt is allowed: samples of there will come, and until then
 * the body's covariance says how far off it may be. A body whose axes are not known is off by more.
 */
constexpr double beyond = 0.1;
/* Of postures that samples come from, and of those that the robot may use, so many can be seen. */
constexpr double most_seen = 0.5;
constexpr double some_seen = 0.1;

/* Directions that no sample tells: a joint's point slides along its axis, and what follows it back;
 * arm and neck go up together; the pitch's axis slides along itself. They are pinned, for whatever
 * stands on the body would otherwise carry a doubt that is none. */
Eigen::MatrixXd gauge(const Data &data, const Candidate &candidate, int n_all)
{
    const struct chain &chain = candidate.body.chain;
    const int of_eyes = data.settings->sees ? 2 : 0;
    Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(data.n + data.n + of_eyes, n_all);

    for (int i = 0; i < data.n; i++) {
        Eigen::Map<const Eigen::Vector3d> w(chain.axis[i]);
        directions.row(i).segment<3>(3 * i) = w.transpose(); /* an axis has no length */
        directions.row(data.n + i).segment<3>(3 * (data.n + i)) = w.transpose();
        if (i + 1 < data.n)
            directions.row(data.n + i).segment<3>(3 * (data.n + i + 1)) = -w.transpose();
        else
            for (int c = 0; c < data.contexts; c++)
                directions.row(data.n + i).segment<3>(data.unknowns() + 3 * c) = -w.transpose();
    }
    if (of_eyes > 0) {
        const int neck = 6 * data.n;
        const int eye = neck + 3;
        directions(2 * data.n, neck + 2) = directions(2 * data.n, 3 * data.n + 2) = 1; /* up */
        directions(2 * data.n + 1, neck + 1) = 1; /* along the pitch's axis */
        directions(2 * data.n + 1, eye + 1) = -1;
    }
    return directions;
}

Eigen::MatrixXd information(const Data &data, double scale, const Candidate &candidate)
{
    const int n = data.unknowns();
    const int n_all = n + 3 * data.contexts;
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n_all, n_all);

    for (const Sample &sample : data.samples) {
        double left[3];
        double by_tip[9];
        std::vector<double> by_unknowns(3 * (size_t)n);
        if (sample.gross)
            continue;
        if (!residual(data, candidate.body, candidate.tips[(size_t)sample.context], sample, left,
                      by_unknowns.data(), by_tip))
            continue;
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, n_all);
        J.leftCols(n) = Eigen::Map<Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>>(
            by_unknowns.data(), 3, n);
        J.middleCols(n + 3 * sample.context, 3) =
            Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(by_tip);
        C += J.transpose() * J / (scale * scale);
    }
    for (int i = 0; i < n_all; i++) {
        double sd = i < 3 * data.n || (i >= 6 * data.n && i < n) ? prior_eye : 3;
        C(i, i) += 1 / (sd * sd);
    }
    constexpr double pinned = 1e-6;
    Eigen::MatrixXd G = gauge(data, candidate, n_all);
    return C + G.transpose() * G / (pinned * pinned);
}

/* What was seen at the posture nearest to q. */
Eigen::Vector3d nearest_output(const Data &data, const double *q)
{
    const Sample *nearest = nullptr;
    double least = INFINITY;

    for (const Sample &sample : data.samples) {
        double distance = 0;
        for (int i = 0; i < data.n; i++)
            distance += (sample.z[i] - q[i]) * (sample.z[i] - q[i]);
        if (distance < least) {
            least = distance;
            nearest = &sample;
        }
    }
    return nearest->x;
}

/* L L' = the inverse of C. */
Eigen::MatrixXd root_of_inverse(const Eigen::MatrixXd &C)
{
    Eigen::MatrixXd inverse = C.ldlt().solve(Eigen::MatrixXd::Identity(C.rows(), C.cols()));
    Eigen::MatrixXd even = (inverse + inverse.transpose()) / 2;

    even.diagonal().array() += 1e-14;
    return even.llt().matrixL();
}

/* How far outputs lie from their mean, rms; of a place, one length for all. */
Eigen::Vector3d spread_of(const Data &data)
{
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    double n = (double)data.samples.size();

    if (!data.settings->sees)
        return Eigen::Vector3d::Constant(data.length / data.unit);
    for (const Sample &sample : data.samples)
        squares += (sample.x - data.middle).cwiseAbs2();
    return (squares / n).cwiseSqrt().cwiseMax(1e-9);
}

/* What context 0 has at the joints q, as a sample of it; false where the eyes cannot look. */
bool answer(const Data &data, const Candidate &candidate, const double *q, Sample &sample)
{
    chain_pose pose;
    double tip[3];
    double ignored[9];

    sample = {q, nearest_output(data, q), 0, false, false};
    chain_at(&candidate.body.chain, q, &pose);
    mat3_apply(pose.turn[data.n], candidate.tips[0].data(), tip);
    vec3_add(1, pose.p, tip);
    return body_output(&candidate.body, tip, sample.x.data(), ignored);
}

/* Squared standard deviations of what context 0 has at the joints q, over `spread`, their mean;
 * below zero where the eyes cannot look. */
double variance_at(const Data &data, const Candidate &candidate, const Eigen::MatrixXd &root,
                   const Eigen::Vector3d &spread, const double *q)
{
    const int n = data.unknowns();
    Sample sample;
    double left[3];
    double by_tip[9];
    std::vector<double> by_unknowns(3 * (size_t)n);

    if (!answer(data, candidate, q, sample) || !residual(data, candidate.body, candidate.tips[0],
                                                         sample, left, by_unknowns.data(), by_tip))
        return -1;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, root.rows());
    J.leftCols(n) = Eigen::Map<Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>>(
        by_unknowns.data(), 3, n);
    J.middleCols(n, 3) = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(by_tip);
    return (data.noise.cwiseQuotient(spread).asDiagonal() * (J * root)).squaredNorm() / 3;
}

/* The mean of `square` over postures in a range; those where it is below zero, where nothing can be
 * seen, are left out. Infinite when fewer than `least` of them, as a share, are left. */
template <typename Square>
double mean_over(const Data::Range &range, random_state &random, double least, Square square)
{
    constexpr int postures = 200;
    std::vector<double> q(range.low.size());
    double sum = 0;
    int seen = 0;

    for (int p = 0; p < postures; p++) {
        for (size_t i = 0; i < q.size(); i++)
            q[i] = random_uniform(&random, range.low[i], range.high[i]);
        double one = square(q.data());
        sum += std::max(one, 0.0);
        seen += one >= 0;
    }
    return seen > least * postures ? sum / seen : INFINITY;
}

} // namespace

double distance(const Data &data, const Candidate &one, const Candidate &other)
{
    const Eigen::Vector3d spread = spread_of(data);
    random_state random = random_seed(0);

    return std::sqrt(mean_over(data.seen, random, most_seen, [&](const double *q) {
        Sample here;
        Sample there;
        if (!answer(data, one, q, here) || !answer(data, other, q, there))
            return -1.0;
        return (here.x - there.x).cwiseQuotient(spread).squaredNorm() / 3;
    }));
}

/* What stands on the body has tips of its own, which give way to the chain as the known tips do: so
 * the body's covariance is that of the chain with these tips given. The doubt is that of all
 * together. */
double judge(const Data &data, double scale, random_state &random, Candidate &candidate)
{
    const int n = data.unknowns();
    const Eigen::Vector3d spread = spread_of(data);
    Eigen::MatrixXd C = information(data, scale, candidate);
    Eigen::MatrixXd given_tips = root_of_inverse(C.topLeftCorner(n, n));
    Eigen::MatrixXd all = root_of_inverse(C);

    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++)
            candidate.body.root[i * (i + 1) / 2 + k] = given_tips(i, k);
    const auto variance = [&](const double *q) {
        return variance_at(data, candidate, all, spread, q);
    };
    double seen = std::sqrt(mean_over(data.seen, random, most_seen, variance));
    double whole = std::sqrt(mean_over(data.whole, random, some_seen, variance));
    return std::min(std::max(seen, beyond * whole), 1e9);
}

} // namespace finder
