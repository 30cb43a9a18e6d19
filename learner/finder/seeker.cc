#include "learner/finder/seeker.h"

#include <ctime>
#include <memory>

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
    double begin = processor_seconds();
    char ignored[160];
    auto body = std::make_unique<struct body>();
    seeker->settings.start = learner_body(learner);
    seeker->settings.seed++;
    seeker->searches++;
    bool found = finder_search(&seeker->settings, contexts, n_contexts, body.get(),
                               &seeker->report) == FINDER_FOUND &&
                 learner_give_body(learner, body.get(), ignored, sizeof ignored) == 0;
    seeker->found += found;
    seeker->seconds += processor_seconds() - begin;
    return found;
}
