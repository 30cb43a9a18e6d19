/* Samples as the solver wants them. */
#include "learner/finder/problem.h"
#include "learner/finder/starts.h"

#include <algorithm>
#include <cmath>

namespace finder
{

namespace
{

/* Whether a joint is known to slide, or was seen to. */
bool slides(const Data &data)
{
    const struct body *start = data.settings->start;
    random_state random = random_seed(0);
    int seen = 0;
    const struct chain chain = start ? start->chain : circle_start(data, random, &seen).body.chain;

    return std::any_of(chain.slides, chain.slides + data.n, [](bool one) { return one; });
}

/* Every fifth sample of a tool that has enough of them judges what the others found. */
void keep_apart(Data &data, const learner_samples *contexts, int n_contexts)
{
    size_t at = 0;

    for (int c = 0; c < n_contexts; c++)
        for (int i = 0; i < contexts[c].n; i++)
            data.samples[at++].apart = contexts[c].n >= 15 && i % 5 == 2;
}

void measure_joints(Data &data)
{
    const finder_settings &settings = *data.settings;

    for (int i = 0; i < data.n; i++) {
        const bool told = settings.low[i] < settings.high[i];
        double low = INFINITY;
        double high = -INFINITY;
        for (const Sample &sample : data.samples) {
            low = std::min(low, sample.z[i]);
            high = std::max(high, sample.z[i]);
        }
        data.seen.low.push_back(low);
        data.seen.high.push_back(high);
        data.whole.low.push_back(told ? std::min(low, settings.low[i]) : low);
        data.whole.high.push_back(told ? std::max(high, settings.high[i]) : high);
    }
}

void measure_outputs(Data &data)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();
    double n = (double)data.samples.size();

    for (const Sample &sample : data.samples)
        sum += sample.x;
    data.middle = sum / n;
    for (const Sample &sample : data.samples)
        squares += (sample.x - data.middle).cwiseAbs2();
    data.length = std::max(std::sqrt(squares.sum() / n), 1e-9);
    data.unit = data.length;
    data.disparity_middle = data.middle[2];
    data.disparity_unit = std::max(2 * std::sqrt(squares[2] / n), 1e-9);
}

} // namespace

Data prepare(const finder_settings &settings, const learner_samples *contexts, int n_contexts)
{
    Data data{};

    data.settings = &settings;
    data.n = settings.n_joints;
    data.contexts = n_contexts;
    for (int c = 0; c < n_contexts; c++)
        for (int i = 0; i < contexts[c].n; i++)
            data.samples.push_back(
                {contexts[c].z + (ptrdiff_t)i * data.n,
                 Eigen::Map<const Eigen::Vector3d>(contexts[c].x + (ptrdiff_t)3 * i), c, false,
                 false});
    measure_joints(data);
    measure_outputs(data);
    keep_apart(data, contexts, n_contexts);
    data.noise = Eigen::Map<const Eigen::Vector3d>(settings.noise);
    if (settings.sees)
        return data;
    data.unit = slides(data) ? 1 : data.length;
    data.noise /= data.unit;
    for (Sample &sample : data.samples)
        sample.x = (sample.x - data.middle) / data.unit;
    return data;
}

} // namespace finder
