#include "learner/finder/finder.h"

#include "learner/finder/judge.h"
#include "learner/finder/problem.h"
#include "learner/finder/starts.h"
#include "learner/finder/tips.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace finder
{

namespace
{

constexpr int fewest = 15;      /* samples, whatever the arm */
constexpr int first_look = 120; /* samples that starts are tried on */
constexpr double near_noise = 2.5;
constexpr double near_arm = 0.004; /* misfit that no wrong chain reaches, of the length */
constexpr double explains = 3.0;  /* misfit kept apart, in units of what the training misfit says */
constexpr double believed = 0.02; /* doubt, of the length of what was seen */
constexpr double chain_like = 0.05; /* misfit that is still an arm's, of the length */
constexpr double as_noisy = 1.5;    /* or, in units of the noise, no more than the sensor's own */
constexpr int many = 150;           /* samples after which an arm that is none is called so */

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
    for (int i = 0; i < data.n; i++) {
        double low = INFINITY;
        double high = -INFINITY;
        for (const Sample &sample : data.samples) {
            low = std::min(low, sample.z[i]);
            high = std::max(high, sample.z[i]);
        }
        data.joint_middle.push_back((low + high) / 2);
        data.joint_range.push_back((high - low) / 2);
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

namespace
{

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

/* A place's misfit over the length of all, from a misfit in units of the noise. */
double relative(const Data &data, double error)
{
    if (data.settings->sees)
        return error * data.noise[2] / data.disparity_unit;
    return error * data.noise.maxCoeff() * data.unit / data.length;
}

/* The misfit of a right chain is under this, in units of the noise. */
double near_truth(const Data &data)
{
    return std::max(near_noise, near_arm / relative(data, 1));
}

/* The best of many starts; stops at the first whose misfit is that of the noise, or when several
 * have come to the same best. */
Candidate search(const Data &data, random_state &random, int *starts)
{
    const Data some = some_of(data, first_look);
    Candidate best{};
    int same = 0;
    int seen = 0;
    bool any = false;
    constexpr int agree = 4;

    for (*starts = 0; *starts < data.settings->starts && same < agree; ++*starts) {
        Candidate candidate = random_start(some, random);
        if (*starts == 0 && data.settings->start)
            candidate = given_start(some, *data.settings->start);
        else if (*starts <= 1 || seen > data.n / 2)
            candidate = circle_start(data, random, &seen);
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
        if (misfit(some, best, false) < near_truth(data)) {
            ++*starts;
            break;
        }
    }
    return best;
}

/* rms distance of what was seen from its middle, in the units of the candidate. */
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

/* The noise that the misfit over the training samples speaks of, each unknown costs a number. */
double noise_of(const Data &data, const Candidate &candidate)
{
    double numbers = 0;
    double known = 4.0 * data.n + (data.settings->sees ? EYES_UNKNOWNS : 0) + 3 * data.contexts;

    for (const Sample &sample : data.samples)
        numbers += sample.apart ? 0 : 3;
    double freedom = std::max(1 - known / numbers, 0.1);
    return std::min(std::max(misfit(data, candidate, false, 0.05) / std::sqrt(freedom), 0.5),
                    100.0);
}

finder_outcome decide(const Data &data, double noise, finder_report *report)
{
    int n = report->samples;

    if (report->error < explains * std::max(noise, 1.0) &&
        (relative(data, report->error) < chain_like || report->error < as_noisy)) {
        report->any_body = true;
        if (report->doubt < believed)
            return FINDER_FOUND;
        std::snprintf(report->why, sizeof report->why,
                      "a chain explains %d samples, but is unsure by %.1f %% of its length", n,
                      100 * report->doubt);
        return FINDER_NOT_YET;
    }
    std::snprintf(report->why, sizeof report->why,
                  "the best chain is off by %.1f times the noise on samples kept apart, of %d",
                  report->error, n);
    return n >= many ? FINDER_NO_CHAIN : FINDER_NOT_YET;
}

void fill_body(const Data &data, Candidate &candidate, double noise, const finder_report &report,
               struct body *body)
{
    *body = in_units(data, candidate);
    for (double &one : body->noise)
        one *= std::max(noise, 0.5);
    body->samples = report.samples;
    body->error = report.error;
    body->doubt = report.doubt;
}

/* A body with what it was found from. */
struct Found {
    Data data;
    Candidate best;
    double noise = 1;
};

/* From these tools; `start` is where it begins, or NULL for a search. */
Found find(const finder_settings &settings, const std::vector<learner_samples> &tools,
           random_state &random, finder_report *report)
{
    Found found;

    found.data = prepare(settings, tools.data(), (int)tools.size());
    report->samples = (int)found.data.samples.size();
    found.best = search(found.data, random, &report->starts);
    if (!settings.start && tools.size() == 1 &&
        misfit(found.data, found.best, false, 0) > near_truth(found.data)) {
        solve(found.data, 60, false, found.best);
        tell_tips_apart(found.data, random, near_truth(found.data), found.best);
    }
    solve(found.data, 60, true, found.best);
    report->error = misfit(found.data, found.best, true);
    found.noise = noise_of(found.data, found.best);
    found.best.body.length = length_of(found.data, found.best);
    report->doubt = judge(found.data, found.noise, random, found.best);
    report->outcome = decide(found.data, found.noise, report);
    return found;
}

/* Tools that bend would bend the chain with them; one that only seemed to, since the chain was not
 * yet right, tells much of it. Each that was thought to bend is tried: it stays if the same chain
 * explains it as well as the others. */
void add_tools(const finder_settings &settings, const std::vector<learner_samples> &bent,
               std::vector<learner_samples> &tools, random_state &random, finder_report *report,
               Found &found)
{
    constexpr double as_well = 1.3;

    for (const learner_samples &tool : bent) {
        struct body known;
        finder_settings from_here = settings;
        finder_report with_it{};
        fill_body(found.data, found.best, found.noise, *report, &known);
        from_here.start = &known;
        from_here.starts = 1;
        tools.push_back(tool);
        Found other = find(from_here, tools, random, &with_it);
        if (with_it.outcome == FINDER_FOUND && with_it.error < as_well * report->error) {
            with_it.starts = report->starts;
            *report = with_it;
            found = other;
        } else {
            tools.pop_back();
        }
    }
}

} // namespace
} // namespace finder

enum finder_outcome finder_search(const struct finder_settings *settings,
                                  const struct learner_samples *contexts, int n_contexts,
                                  struct body *body, struct finder_report *report)
{
    using namespace finder;
    std::vector<learner_samples> rigid;
    std::vector<learner_samples> bent;
    random_state random = random_seed(settings->seed);
    int n = 0;

    *report = {};
    for (int c = 0; c < n_contexts; c++)
        (contexts[c].rigid ? rigid : bent).push_back(contexts[c]);
    for (const learner_samples &tool : rigid)
        n += tool.n;
    if (n < fewest) { /* what bends is better than nothing */
        for (const learner_samples &tool : bent)
            n += tool.n;
        rigid.insert(rigid.end(), bent.begin(), bent.end());
        bent.clear();
    }
    if (n < fewest) {
        report->samples = n;
        report->outcome = FINDER_NOT_YET;
        report->error = report->doubt = INFINITY;
        std::snprintf(report->why, sizeof report->why, "%d samples are too few", n);
        return FINDER_NOT_YET;
    }
    Found found = find(*settings, rigid, random, report);
    if (report->outcome != FINDER_FOUND) {
        if (report->any_body)
            fill_body(found.data, found.best, found.noise, *report, body);
        return report->outcome;
    }
    add_tools(*settings, bent, rigid, random, report, found);
    for (Sample &sample : found.data.samples) /* they have judged: now they teach */
        sample.apart = false;
    solve(found.data, 60, true, found.best);
    found.best.body.length = length_of(found.data, found.best);
    report->doubt = judge(found.data, found.noise, random, found.best);
    fill_body(found.data, found.best, found.noise, *report, body);
    std::snprintf(report->why, sizeof report->why, "found from %d samples", report->samples);
    return report->outcome;
}
