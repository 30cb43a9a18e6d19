#include "learner/finder/multistart.h"

#include "learner/finder/judge.h"
#include "learner/finder/starts.h"

#include <algorithm>
#include <cmath>

namespace finder
{

namespace
{

constexpr int first_look = 120; /* samples that starts are tried on */
constexpr double near_noise = 2.5;
constexpr double near_arm = 0.004; /* misfit that no wrong chain reaches, of the length */
constexpr double as_likely = 10;   /* log: a chain that is less likely by more is out of question */
constexpr double another = 0.1;    /* farther apart, of the length, two are not the same chain */

/* At most `most` of the samples that are not kept apart, evenly. */
Data some_of(const Data &data, size_t most)
{
    Data some = data;
    std::vector<Sample> training;

    for (const Sample &sample : data.samples)
        if (!sample.apart)
            training.push_back(sample);
    some.samples.clear();
    size_t n = std::min(training.size(), most);
    for (size_t i = 0; i < n; i++)
        some.samples.push_back(training[i * training.size() / n]);
    return some;
}

/* Joints that were turned alone tell where to begin; `look`: whether there are such joints is not
 * known yet, and stays in *seen. */
Candidate next_start(const Data &data, const Data &some, bool look, random_state &random, int *seen)
{
    if (look || *seen > data.n / 2)
        return circle_start(data, random, seen);
    return random_start(some, random);
}

} // namespace

double relative(const Data &data, double error)
{
    if (data.settings->sees)
        return error * data.noise[2] / data.disparity_unit;
    return error * data.noise.maxCoeff() * data.unit / data.length;
}

double near_truth(const Data &data)
{
    return std::max(near_noise, near_arm / relative(data, 1));
}

Candidate search(const Data &data, random_state &random, int *starts)
{
    const Data some = some_of(data, first_look);
    Candidate best{};
    int same = 0;
    int seen = 0;
    bool any = false;
    constexpr int agree = 4;

    for (*starts = 0; *starts < data.settings->starts && same < agree; ++*starts) {
        Candidate candidate = *starts == 0 && data.settings->start
                                  ? given_start(some, *data.settings->start)
                                  : next_start(data, some, *starts <= 1, random, &seen);
        solve(some, 40, false, candidate);
        if (any && candidate.cost > 30 * best.cost && candidate.cost > 1e4)
            continue;
        solve(some, 160, false, candidate);
        same = any && candidate.cost > best.cost * 0.98 && candidate.cost < best.cost * 1.02
                   ? same + 1
                   : same;
        if (!any || candidate.cost < best.cost) {
            same = any && candidate.cost > best.cost * 0.98 ? same : 0;
            best = candidate;
            any = true;
        }
        if (misfit(some, best, false) < near_truth(data) || noise_factor(data, best) > 1) {
            ++*starts;
            break;
        }
    }
    return best;
}

double rivalry(const Data &data, double noise, random_state &random, Candidate &candidate)
{
    const Data some = some_of(data, first_look);
    const double likely = as_likely * std::max(noise * noise, 1.0);
    Candidate settled = candidate;
    int seen = 0;

    solve(some, 60, false, settled);
    for (int k = 0; k < data.settings->starts / 2; k++) {
        Candidate rival = next_start(data, some, k == 0, random, &seen);
        solve(some, 40, false, rival);
        if (rival.cost > 30 * (settled.cost + likely))
            continue;
        solve(some, 160, false, rival);
        if (!(rival.cost < settled.cost + likely))
            continue;
        double apart = distance(data, settled, rival);
        if (rival.cost < settled.cost)
            candidate = rival;
        if (apart > another)
            return apart;
    }
    return 0;
}

} // namespace finder
