#include "learner/finder/starts.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

namespace finder
{

namespace
{

double normal(random_state &random)
{
    double u = random_uniform(&random, 0x1p-53, 1);

    return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * random_uniform(&random, 0, 1));
}

Eigen::Vector3d normals(random_state &random, double sd)
{
    double x = normal(random);
    double y = normal(random);

    return {sd * x, sd * y, sd * normal(random)};
}

/* A candidate with everything that is not unknown. */
Candidate blank(const Data &data)
{
    Candidate candidate{};
    struct body &body = candidate.body;

    body.chain.n = data.n;
    body.sees = data.settings->sees;
    body.length = 1;
    for (int i = 0; i < data.n; i++) {
        const double low = data.seen.low[(size_t)i];
        const double high = data.seen.high[(size_t)i];
        body.chain.middle[i] = (low + high) / 2;
        body.range[i] = (high - low) / 2;
        body.chain.axis[i][2] = 1;
    }
    for (int i = 0; i < BODY_OUTPUTS; i++) {
        body.noise[i] = data.noise[i];
        body.gravity[i] = data.settings->gravity[i];
    }
    body.eyes.angle_unit = data.settings->angle_unit;
    body.eyes.disparity_middle = data.disparity_middle;
    body.eyes.disparity_unit = data.disparity_unit;
    body.eyes.law[0] = 2; /* sets the unit of length: the middle of all depths is half of it */
    candidate.tips.assign((size_t)data.contexts, Eigen::Vector3d::Zero());
    return candidate;
}

} // namespace

Candidate random_start(const Data &data, random_state &random)
{
    Candidate candidate = blank(data);
    Eigen::VectorXd v = unknowns_of(data, candidate);
    const double length = data.settings->sees ? 0.2 : 1;

    for (int i = 0; i < data.n; i++) {
        v.segment<3>(3 * i) = normals(random, 1);
        v.segment<3>(3 * (data.n + i)) = normals(random, length);
    }
    if (data.settings->sees) {
        Eigen::VectorXd eyes(EYES_UNKNOWNS);
        Eigen::Vector3d neck = normals(random, 0.1);
        Eigen::Vector3d eye = normals(random, 0.05);
        double tilt = 0.3 * normal(random);
        eyes << neck, eye, tilt, 0.3 * normal(random), 0.3 * std::abs(normal(random)), 0;
        v.tail<EYES_UNKNOWNS>() = eyes;
    }
    take_unknowns(data, v, candidate);
    for (Eigen::Vector3d &tip : candidate.tips)
        tip = normals(random, length);
    return candidate;
}

Candidate given_start(const Data &data, const struct body &given)
{
    Candidate candidate = blank(data);
    const double unit = data.settings->sees ? 1 : data.unit;

    candidate.body.chain = given.chain;
    candidate.body.eyes = given.eyes;
    for (int i = 0; i < data.n; i++)
        for (int k = 0; k < 3; k++) {
            double middle = i == 0 && !data.settings->sees ? data.middle[k] : 0;
            candidate.body.chain.offset[i][k] = (given.chain.offset[i][k] - middle) / unit;
        }
    return candidate;
}

struct body in_units(const Data &data, const Candidate &candidate)
{
    struct body body = candidate.body;

    if (body.sees) /* what eyes say has no length to give back */
        return body;
    body.length *= data.unit;
    for (int i = 0; i < data.n; i++)
        for (int k = 0; k < 3; k++)
            body.chain.offset[i][k] =
                data.unit * body.chain.offset[i][k] + (i == 0 ? data.middle[k] : 0);
    for (int i = 3 * data.n; i < 6 * data.n; i++)
        for (int k = 0; k <= i; k++)
            body.root[i * (i + 1) / 2 + k] *= data.unit;
    for (double &noise : body.noise)
        noise *= data.unit;
    return body;
}

namespace
{

constexpr double still = 0.01;       /* rad: a joint that differs less was not turned */
constexpr double least_sweep = 0.35; /* rad, from end to end */
constexpr size_t least_points = 5;

/* The joint in which a sample differs from the posture alone; -1 none differs, -2 several do. */
int only_moved(const Data &data, const double *z, const double *posture)
{
    int moved = -1;

    for (int i = 0; i < data.n; i++)
        if (std::abs(z[i] - posture[i]) > still) {
            if (moved >= 0)
                return -2;
            moved = i;
        }
    return moved;
}

using Sweeps = std::vector<std::vector<const Sample *>>;

/* For each joint the samples in which it alone was turned away from the posture. */
Sweeps sweeps_from(const Data &data, const double *posture)
{
    Sweeps sweeps((size_t)data.n);

    for (const Sample &sample : data.samples) {
        int joint = sample.context == 0 ? only_moved(data, sample.z, posture) : -2;
        if (joint >= 0)
            sweeps[(size_t)joint].push_back(&sample);
    }
    for (int i = 0; i < data.n; i++) {
        double low = 0;
        double high = 0;
        for (const Sample *sample : sweeps[(size_t)i]) {
            low = std::min(low, sample->z[i] - posture[i]);
            high = std::max(high, sample->z[i] - posture[i]);
        }
        if (sweeps[(size_t)i].size() < least_points || high - low < least_sweep)
            sweeps[(size_t)i].clear();
    }
    return sweeps;
}

int drawn(const Sweeps &sweeps)
{
    int count = 0;

    for (const auto &sweep : sweeps)
        count += !sweep.empty();
    return count;
}

/* x = b + u sin a + v (1 - cos a), or x = b + u a: least squares; returns the squared misfit. */
double fit_motion(const std::vector<const Sample *> &sweep, int joint, double from, bool line,
                  Eigen::Matrix3d &coefficients)
{
    Eigen::MatrixXd A(sweep.size(), line ? 2 : 3);
    Eigen::MatrixXd X(sweep.size(), 3);

    for (size_t k = 0; k < sweep.size(); k++) {
        double a = sweep[k]->z[joint] - from;
        if (line)
            A.row((Eigen::Index)k) << 1, a;
        else
            A.row((Eigen::Index)k) << 1, std::sin(a), 1 - std::cos(a);
        X.row((Eigen::Index)k) = sweep[k]->x.transpose();
    }
    Eigen::MatrixXd c = A.colPivHouseholderQr().solve(X);
    coefficients.setZero();
    coefficients.topRows(c.rows()) = c;
    return (A * c - X).squaredNorm();
}

/* A joint's axis and a point on it, at the posture. */
struct Screw {
    bool slides = false;
    Eigen::Vector3d axis, point;
};

/* What one joint's sweep tells; `here` is where the end-effector is at the posture. */
Screw screw_of(const Data &data, const std::vector<const Sample *> &sweep, int joint, double from,
               const Eigen::Vector3d &here, random_state &random)
{
    Screw screw;
    Eigen::Matrix3d circle;
    Eigen::Matrix3d line;

    screw.axis = normals(random, 1).normalized();
    screw.point = here;
    if (sweep.empty())
        return screw;
    double of_circle = fit_motion(sweep, joint, from, false, circle);
    double of_line = fit_motion(sweep, joint, from, true, line);
    Eigen::Vector3d b = circle.row(0).transpose();
    Eigen::Vector3d u = circle.row(1).transpose();
    Eigen::Vector3d v = circle.row(2).transpose();
    if (u.norm() < 5 * data.noise.maxCoeff()) /* it does not move the hand */
        return screw;
    if (of_line < of_circle) {
        screw.slides = true;
        screw.axis = line.row(1).transpose().normalized();
        return screw;
    }
    screw.axis = u.cross(v).normalized();
    /* v is across u, towards the centre, and as long. */
    screw.point = b + v - u * (u.dot(v) / u.squaredNorm());
    return screw;
}

} // namespace

Candidate circle_start(const Data &data, random_state &random, int *seen)
{
    Candidate candidate = random_start(data, random);
    const double *posture = nullptr;
    Sweeps best((size_t)data.n);
    Eigen::Vector3d here = Eigen::Vector3d::Zero();

    *seen = 0;
    for (const Sample &sample : data.samples) {
        if (sample.context != 0)
            continue;
        Sweeps sweeps = sweeps_from(data, sample.z);
        if (drawn(sweeps) > *seen) {
            *seen = drawn(sweeps);
            best = sweeps;
            posture = sample.z;
            here = sample.x;
        }
    }
    if (!posture)
        return candidate;
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (int i = 0; i < data.n; i++) {
        Screw screw = screw_of(data, best[(size_t)i], i, posture[i], here, random);
        candidate.body.chain.slides[i] = screw.slides;
        candidate.body.chain.middle[i] = posture[i];
        for (int k = 0; k < 3; k++) {
            candidate.body.chain.axis[i][k] = screw.axis[k];
            candidate.body.chain.offset[i][k] = screw.point[k] - before[k];
        }
        before = screw.point;
    }
    for (Eigen::Vector3d &tip : candidate.tips)
        tip = here - before;
    return candidate;
}

} // namespace finder
