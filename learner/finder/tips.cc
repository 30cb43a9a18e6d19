#include "learner/finder/tips.h"

#include "learner/body/chain/vec3.h"
#include "learner/finder/judge.h"

#include <algorithm>
#include <cmath>

namespace finder
{

namespace
{

constexpr int most_tips = 4;
constexpr int fewest_of_tip = 8;
constexpr int rounds = 15;
constexpr double far = 5;          /* from its tip, in units of the median: left out */
constexpr double most_gross = 0.2; /* share that may be left out */

/* Where a sample's tip is in the last frame; false where the eyes cannot see. */
bool tip_of(const Data &data, const Candidate &candidate, const Sample &sample,
            Eigen::Vector3d &tip)
{
    chain_pose pose;
    double place[3];
    double white[9];

    if (!body_place(&candidate.body, sample.x.data(), place, white))
        return false;
    chain_at(&candidate.body.chain, sample.z, &pose);
    vec3_add(-1, pose.p, place);
    mat3_apply_transposed(pose.turn[data.n], place, tip.data());
    return true;
}

using Points = std::vector<Eigen::Vector3d>;

size_t nearest(const Points &centres, const Eigen::Vector3d &point)
{
    size_t best = 0;

    for (size_t c = 1; c < centres.size(); c++)
        if ((centres[c] - point).squaredNorm() < (centres[best] - point).squaredNorm())
            best = c;
    return best;
}

/* Sum of distances (not squared: some are of nothing). */
double spread_about(const Points &points, const Points &centres)
{
    double sum = 0;

    for (const Eigen::Vector3d &point : points)
        sum += (point - centres[nearest(centres, point)]).norm();
    return sum;
}

/* Each centre to where the points that are nearest to it have their weighted middle, by which far
 * ones count little. */
void centre(const Points &points, Points &centres)
{
    for (int round = 0; round < 20; round++) {
        Points sums(centres.size(), Eigen::Vector3d::Zero());
        std::vector<double> weights(centres.size(), 0);
        for (const Eigen::Vector3d &point : points) {
            size_t c = nearest(centres, point);
            double weight = 1 / std::max((point - centres[c]).norm(), 1e-6);
            sums[c] += weight * point;
            weights[c] += weight;
        }
        for (size_t c = 0; c < centres.size(); c++)
            if (weights[c] > 0)
                centres[c] = sums[c] / weights[c];
    }
}

/* The best of some draws of n centres from the points. */
Points centres_of(const Points &points, int n, random_state &random)
{
    Points best;
    double least = INFINITY;
    constexpr int draws = 20;

    for (int draw = 0; draw < draws; draw++) {
        Points centres;
        for (int c = 0; c < n; c++)
            centres.push_back(points[random_bits(&random) % points.size()]);
        centre(points, centres);
        double spread = spread_about(points, centres);
        if (spread < least) {
            least = spread;
            best = centres;
        }
    }
    return best;
}

double median(std::vector<double> values, double share = 0.5)
{
    auto middle = values.begin() + (ptrdiff_t)(share * (double)(values.size() - 1));

    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/* Gives each sample to the tip that explains it best, leaves out the far ones; returns how many
 * changed. */
int give_to_tips(Data &data, const Candidate &candidate)
{
    std::vector<double> distances;
    std::vector<double> of_training;
    int changed = 0;

    for (Sample &sample : data.samples) {
        double least = INFINITY;
        int best = sample.context;
        for (size_t c = 0; c < candidate.tips.size(); c++) {
            double left[3];
            if (!residual(data, candidate.body, candidate.tips[c], sample, left, nullptr, nullptr))
                continue;
            double distance = vec3_length(left);
            if (distance < least) {
                least = distance;
                best = (int)c;
            }
        }
        changed += best != sample.context;
        sample.context = best;
        distances.push_back(least);
        if (!sample.apart)
            of_training.push_back(least);
    }
    double limit =
        std::max(far * std::max(median(of_training), 1.0), median(of_training, 1 - most_gross));
    for (size_t i = 0; i < distances.size(); i++) {
        bool gross = distances[i] > limit;
        changed += gross != data.samples[i].gross;
        data.samples[i].gross = gross;
    }
    return changed;
}

bool each_has_enough(const Data &data)
{
    std::vector<int> count((size_t)data.contexts, 0);

    for (const Sample &sample : data.samples)
        count[(size_t)sample.context] += !sample.gross;
    return *std::min_element(count.begin(), count.end()) >= fewest_of_tip;
}

/* With n tips, from this candidate on. */
bool settle(Data &data, int n, random_state &random, double enough, Candidate &candidate)
{
    Points points;
    Eigen::Vector3d tip;

    for (const Sample &sample : data.samples)
        if (!sample.apart && tip_of(data, candidate, sample, tip))
            points.push_back(tip);
    if (points.size() < (size_t)n * fewest_of_tip)
        return false;
    data.contexts = n;
    candidate.tips = centres_of(points, n, random);
    for (int round = 0; round < rounds; round++) {
        if (give_to_tips(data, candidate) == 0 && round > 0)
            break;
        solve(data, 30, false, candidate);
    }
    return each_has_enough(data) && misfit(data, candidate, false, 0) < enough;
}

} // namespace

bool tell_tips_apart(Data &data, random_state &random, double enough, Candidate &candidate)
{
    for (int n = 1; n <= most_tips; n++) {
        Data sorted = data;
        Candidate settled = candidate;
        if (settle(sorted, n, random, enough, settled)) {
            data = sorted;
            candidate = settled;
            return true;
        }
    }
    return false;
}

} // namespace finder
