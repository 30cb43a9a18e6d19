/* The least-squares problem of a body: its unknowns, its residuals, and Ceres on top of them. */
#ifndef REACH_LEARNER_FINDER_PROBLEM_H
#define REACH_LEARNER_FINDER_PROBLEM_H

#include <Eigen/Core>
#include <vector>

#include "learner/finder/finder.h"

namespace finder
{

struct Sample {
    const double *z;
    Eigen::Vector3d x; /* in the problem's units */
    int context;
    bool apart; /* kept apart, to judge by */
    bool gross; /* of nothing that an arm does: left out */
};

/* Samples in units that suit the solver: of a place, its distance from the middle of all places
 * over `unit`; what eyes say, as it is. */
struct Data {
    const finder_settings *settings;
    int n; /* joints */
    int contexts;
    Eigen::Vector3d middle;
    double length;         /* rms distance of places from their middle */
    double unit;           /* the same, or 1 where a joint slides: by how much its own unit says */
    Eigen::Vector3d noise; /* in the problem's units */
    struct Range {
        std::vector<double> low, high;
    };
    Range seen;  /* that samples went through */
    Range whole; /* and that the robot may use */
    double disparity_middle, disparity_unit;
    std::vector<Sample> samples;

    int unknowns() const
    {
        return 6 * n + (settings->sees ? EYES_UNKNOWNS : 0);
    }
};

Data prepare(const finder_settings &settings, const learner_samples *contexts, int n_contexts);

/* A body in the problem's units, and the tip that each context has on it. */
struct Candidate {
    struct body body;
    std::vector<Eigen::Vector3d> tips;
    double cost = 0; /* half the sum of squared residuals */
};

/* The unknowns of a candidate in one vector: axes, offsets, eyes. */
Eigen::VectorXd unknowns_of(const Data &data, const Candidate &candidate);
void take_unknowns(const Data &data, const Eigen::VectorXd &unknowns, Candidate &candidate);

/* What is left between the candidate and a sample, in units of the noise. false where the eyes
 * cannot see. by_unknowns (3 x unknowns()) and by_tip (3 x 3) may be NULL; row by row. */
bool residual(const Data &data, const struct body &body, const Eigen::Vector3d &tip,
              const Sample &sample, double *left, double *by_unknowns, double *by_tip);

/* Improves the candidate on the samples that are not kept apart. robust: gross errors count little.
 */
void solve(const Data &data, int most_iterations, bool robust, Candidate &candidate);

/* Standard deviations of the weak priors that settle what no sample can: in the problem's units. */
constexpr double prior_offset = 10;
constexpr double prior_axis = 10;
constexpr double prior_eye = 1;

} // namespace finder

#endif
