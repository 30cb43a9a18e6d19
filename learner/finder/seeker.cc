#include "learner/finder/seeker.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

namespace
{

constexpr int first_search = 15;     /* samples that differ */
constexpr double more_kept = 1.25;   /* times as many before the next search */
constexpr double more_refined = 1.1; /* the same once there is a body to begin with */
constexpr double more_learned = 2;   /* the same of samples learned, once there is a body */
constexpr uint64_t first_refined = 500;

double processor_seconds()
{
    timespec now{};

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int gather(const struct learner *learner, learner_samples *contexts)
{
    int n = 0;

    for (int c = 0; c < LEARNER_MAX_SOLUTIONS; c++) {
        learner_samples samples = learner_kept_samples(learner, c);
        if (samples.n > 0)
            contexts[n++] = samples;
    }
    return n;
}

} // namespace

void seeker_init(struct seeker *seeker, const struct learner_config *config)
{
    struct finder_settings &settings = seeker->settings;

    *seeker = {};
    settings.n_joints = config->n_inputs;
    settings.sees = config->body.space == LEARNER_BODY_EYES;
    settings.angle_unit = config->body.degrees ? M_PI / 180 : 1;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        settings.noise[i] = std::sqrt(config->psi0[i] * config->noise_share);
    settings.gravity[2] = -1;
    settings.starts = config->body.starts;
    seeker->next_kept = first_search;
    seeker->next_learned = first_refined;
}

bool seeker_look(struct seeker *seeker, struct learner *learner)
{
    learner_samples contexts[LEARNER_MAX_SOLUTIONS];
    int n_contexts = gather(learner, contexts);
    int kept = 0;

    for (int c = 0; c < n_contexts; c++)
        kept += contexts[c].n;
    const struct body *now = learner_body(learner);
    learner_statistics statistics = learner_get_statistics(learner);
    uint64_t learned = statistics.samples + statistics.outliers + statistics.full;
    if (kept < seeker->next_kept && learned < seeker->next_learned)
        return false;
    seeker->next_kept =
        std::max(seeker->next_kept, (int)std::ceil((now ? more_refined : more_kept) * kept));
    seeker->next_learned =
        std::max(seeker->next_learned, (uint64_t)(more_learned * (double)learned));
    double begin = processor_seconds();
    char ignored[160];
    auto body = std::make_unique<struct body>();
    seeker->settings.start = now;
    seeker->settings.seed++;
    seeker->searches++;
    bool found = finder_search(&seeker->settings, contexts, n_contexts, body.get(),
                               &seeker->report) == FINDER_FOUND &&
                 learner_give_body(learner, body.get(), ignored, sizeof ignored) == 0;
    seeker->found += found;
    seeker->seconds += processor_seconds() - begin;
    if (found && seeker->found == 1) {
        seeker->found_at = learned;
        seeker->found_seconds = seeker->seconds;
    }
    return found;
}
