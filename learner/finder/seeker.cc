#include "learner/finder/seeker.h"

#include <ctime>

namespace
{

double processor_seconds()
{
    timespec now{};

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

} // namespace

void seeker_init(struct seeker *seeker, const struct learner_config *config)
{
    *seeker = {};
    seeker->settings = finder_settings_of(config);
    seeker->schedule = body_schedule_begin();
}

bool seeker_look(struct seeker *seeker, struct learner *learner)
{
    learner_samples contexts[LEARNER_MAX_SOLUTIONS];

    if (!body_schedule_due(&seeker->schedule, learner))
        return false;
    body_schedule_searched(&seeker->schedule, learner);
    int n_contexts = body_schedule_samples(learner, contexts);
    uint64_t learned = learner_get_statistics(learner).samples;
    double begin = processor_seconds();
    char ignored[160];
    struct body start = seeker->body;
    const struct body *now = learner_body(learner);
    seeker->settings.start = now ? now : seeker->any_body ? &start : nullptr;
    seeker->settings.seed++;
    seeker->searches++;
    finder_outcome outcome =
        finder_search(&seeker->settings, contexts, n_contexts, &seeker->body, &seeker->report);
    bool found = outcome == FINDER_FOUND &&
                 learner_give_body(learner, &seeker->body, ignored, sizeof ignored) == 0;
    seeker->any_body = seeker->any_body || seeker->report.any_body;
    seeker->found += found;
    seeker->seconds += processor_seconds() - begin;
    if (outcome == FINDER_REFUTED) {
        static const struct body none = {};
        seeker->any_body = seeker->report.any_body;
        learner_give_body(learner, &none, ignored, sizeof ignored);
        seeker->schedule = body_schedule_begin();
        return true;
    }
    if (found && seeker->found == 1) {
        seeker->found_at = learned;
        seeker->found_seconds = seeker->seconds;
    }
    return found;
}
