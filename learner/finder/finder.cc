#include "learner/finder/finder.h"

#include "learner/finder/judge.h"
#include "learner/finder/multistart.h"
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

constexpr int fewest = 15;        /* samples, whatever the arm */
constexpr double explains = 3.0;  /* misfit kept apart, in units of what the training misfit says */
constexpr double believed = 0.02; /* doubt, of the length of what was seen */
constexpr double blind = 1e9; /* doubt of what sees nothing in most postures: no start for others */
constexpr double chain_like = 0.05; /* misfit that is still an arm's, of the length */
constexpr double as_noisy = 1.5;    /* or, in units of the noise, no more than the sensor's own */
constexpr int many = 150;           /* samples after which an arm that is none is called so */

/* What can be known of a body and its tips, over the numbers that the training samples have. */
double knowns_share(const Data &data)
{
    double numbers = 0;
    double known = 4.0 * data.n + (data.settings->sees ? EYES_UNKNOWNS : 0) + 3 * data.contexts;

    for (const Sample &sample : data.samples)
        numbers += sample.apart ? 0 : 3;
    return known / numbers;
}

/* The noise that the misfit over the training samples speaks of, each unknown costs a number. */
double noise_of(const Data &data, const Candidate &candidate)
{
    double freedom = std::max(1 - knowns_share(data), 0.1);

    return std::min(std::max(misfit(data, candidate, false, 0.05) / std::sqrt(freedom), 0.5),
                    100.0);
}

/* A body with what it was found from. */
struct Found {
    Data data;
    Candidate best;
    double noise = 1;
    double told = 1; /* how many times the noise told that of the data is */
};

/* Whether a chain explains what was kept apart. */
bool explained(const Found &found, const finder_report &report)
{
    double error = report.error / found.told;

    return error < explains * std::max(found.noise, 1.0) &&
           (relative(found.data, error) < chain_like || error < as_noisy);
}

finder_outcome decide(const Found &found, finder_report *report)
{
    int n = report->samples;

    if (explained(found, *report)) {
        report->any_body = report->doubt < blind;
        if (report->doubt < believed)
            return FINDER_FOUND;
        if (report->doubt < 1)
            std::snprintf(report->why, sizeof report->why,
                          "a chain explains %d samples, but is unsure by %.1f %% of its length", n,
                          100 * report->doubt);
        else
            std::snprintf(report->why, sizeof report->why,
                          "a chain explains %d samples, but is unsure by more than its length", n);
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

bool was_believed(const struct body *start)
{
    return start && start->samples > 0 && start->doubt < believed;
}

/* It is still the first start that explains the samples, and that was believed already or comes
 * from the robot's maker: it has no rivals, and holds where no sample is. */
bool is_trusted(const finder_settings &settings, const finder_report &report)
{
    const struct body *start = settings.start;

    return start && report.starts == 1 && (start->samples == 0 || was_believed(start));
}

/* Fills what the report says of the candidate, and its covariance. */
void weigh(Found &found, random_state &random, finder_report *report)
{
    solve(found.data, 60, true, found.best);
    report->error = found.told * misfit(found.data, found.best, true);
    found.noise = noise_of(found.data, found.best);
    found.best.body.length = length_of(found.data, found.best);
    report->doubt = judge(found.data, found.noise, random, found.best);
    report->outcome = decide(found, report);
}

/* Where the noise told is far from the samples' own, they are judged by that. Where no chain
 * explains samples of one tool, they may be of several. */
void look_closer(const finder_settings &settings, size_t tools, random_state &random, Found &found)
{
    solve(found.data, 60, false, found.best);
    found.told = noise_factor(found.data, found.best);
    found.data.noise *= found.told;
    for (double &one : found.best.body.noise)
        one *= found.told;
    if (!settings.start && tools == 1 && found.told <= 1)
        tell_tips_apart(found.data, random, near_truth(found.data), found.best);
}

/* From these tools; `start` is where it begins, or NULL for a search. */
Found find(const finder_settings &settings, const std::vector<learner_samples> &tools,
           random_state &random, finder_report *report)
{
    Found found;

    found.data = prepare(settings, tools.data(), (int)tools.size());
    report->samples = (int)found.data.samples.size();
    found.best = search(found.data, random, &report->starts);
    if (misfit(found.data, found.best, false, 0) > near_truth(found.data))
        look_closer(settings, tools.size(), random, found);
    bool trusted = is_trusted(settings, *report);
    if (trusted)
        found.data.whole = found.data.seen;
    weigh(found, random, report);
    if (report->outcome != FINDER_FOUND || trusted)
        return found;
    double apart = rivalry(found.data, found.noise, random, found.best);
    if (apart > 0) {
        weigh(found, random, report);
        report->doubt = std::min(std::max(report->doubt, apart), 1e9);
        report->outcome = decide(found, report);
    }
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
        if (tool.n < fewest)
            continue; /* so few can be explained by any chain */
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
            found.data.settings = &settings;
        } else {
            tools.pop_back();
        }
    }
}

/* Every sample, as if all were of one tool. */
struct Pool {
    std::vector<double> z, x;

    Pool(int n_joints, const learner_samples *contexts, int n_contexts)
    {
        for (const learner_samples *one = contexts; one < contexts + n_contexts; one++) {
            z.insert(z.end(), one->z, one->z + (ptrdiff_t)one->n * n_joints);
            x.insert(x.end(), one->x, one->x + (ptrdiff_t)one->n * BODY_OUTPUTS);
        }
    }

    learner_samples view() const
    {
        return {true, (int)x.size() / BODY_OUTPUTS, z.data(), x.data()};
    }
};

/* Whether a body that was believed is to go, though none is found instead: what a simpler
 * explanation, with fewer tools, does as well is not known; and what no chain explains any more is
 * none. */
bool is_refuted(const finder_settings &settings, int n_contexts, const finder_report &report,
                const Found &anew, const finder_report &of_anew)
{
    constexpr double ample = 1.0 / 3;

    if (of_anew.any_body)
        return anew.data.contexts < n_contexts && knowns_share(anew.data) < ample;
    return report.outcome == FINDER_NO_CHAIN && of_anew.outcome == FINDER_NO_CHAIN &&
           settings.start->error < explains;
}

/* A body that was believed may be wrong, and then it takes one hand for several tools, or for one
 * that bends. So where it explains its samples no longer, or what it takes for tools that bend is
 * most of all samples, they are looked at anew: from nothing, and as if all were of one tool. */
void doubt_start(const finder_settings &settings, const Pool &pool, int n_contexts,
                 random_state &random, finder_report *report, Found &found)
{
    finder_settings from_nothing = settings;
    finder_report of_anew{};
    bool explained = report->outcome == FINDER_FOUND;

    from_nothing.start = nullptr;
    Found anew = find(from_nothing, {pool.view()}, random, &of_anew);
    bool better =
        of_anew.outcome == FINDER_FOUND && (!explained || anew.data.contexts < n_contexts);
    if (!better && explained)
        return;
    if (!better && is_refuted(settings, n_contexts, *report, anew, of_anew)) {
        of_anew.outcome = FINDER_REFUTED;
        better = true;
    }
    of_anew.starts += report->starts;
    if (!better) {
        report->starts = of_anew.starts;
        return;
    }
    *report = of_anew;
    found = anew;
    found.data.settings = &settings;
}

/* Those that have judged teach, too. */
void teach_all(Found &found, random_state &random, finder_report *report)
{
    for (Sample &sample : found.data.samples)
        sample.apart = false;
    solve(found.data, 60, true, found.best);
    found.best.body.length = length_of(found.data, found.best);
    report->doubt = judge(found.data, found.noise, random, found.best);
    int length =
        std::snprintf(report->why, sizeof report->why, "found from %d samples", report->samples);
    if (found.told > 1)
        std::snprintf(report->why + length, sizeof report->why - (size_t)length,
                      ", whose noise is %.0f times what was told", found.told);
}

int count(const std::vector<learner_samples> &tools)
{
    int n = 0;

    for (const learner_samples &tool : tools)
        n += tool.n;
    return n;
}

/* With enough samples of tools that are rigid, or of any. */
void search_in(const finder_settings &settings, std::vector<learner_samples> &rigid,
               const std::vector<learner_samples> &bent, const Pool &pool, random_state &random,
               finder_report *report, struct body *body)
{
    const int n_contexts = (int)(rigid.size() + bent.size());
    Found found = find(settings, rigid, random, report);

    if (was_believed(settings.start) &&
        (report->outcome != FINDER_FOUND || count(bent) > count(rigid)))
        doubt_start(settings, pool, n_contexts, random, report, found);
    if (report->outcome == FINDER_FOUND) {
        if (report->samples < count(rigid) + count(bent))
            add_tools(settings, bent, rigid, random, report, found);
        teach_all(found, random, report);
    }
    if (!report->any_body)
        return;
    char unused[160];
    struct body come_to;
    fill_body(found.data, found.best, found.noise, *report, &come_to);
    report->any_body = body_check(&come_to, unused, sizeof unused) == 0;
    if (report->any_body)
        *body = come_to;
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

    *report = {};
    for (int c = 0; c < n_contexts; c++)
        (contexts[c].rigid ? rigid : bent).push_back(contexts[c]);
    if (count(rigid) < fewest) { /* what bends is better than nothing */
        rigid.insert(rigid.end(), bent.begin(), bent.end());
        bent.clear();
    }
    if (count(rigid) < fewest) {
        report->samples = count(rigid);
        report->outcome = FINDER_NOT_YET;
        report->error = report->doubt = INFINITY;
        std::snprintf(report->why, sizeof report->why, "%d samples are too few", report->samples);
        return FINDER_NOT_YET;
    }
    search_in(*settings, rigid, bent, Pool(settings->n_joints, contexts, n_contexts), random,
              report, body);
    return report->outcome;
}
