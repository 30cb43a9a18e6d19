#include "learner/body/search/schedule.h"

/* Samples that differ, of the first search, and how many times as many before the next. */
static const int first_search = 15;
static const double more_kept = 1.25;
static const double more_refined = 1.05; /* the same once there is a body to begin with */
/* What is kept is bounded and follows the robot. So a search is also due when so many were learned,
 * and then with each doubling: to refine the body in use, or to find one at last. */
static const uint64_t first_learned = 500;
static const uint64_t more_learned = 2;

struct body_schedule body_schedule_begin(void)
{
    return (struct body_schedule){first_search, first_learned};
}

int body_schedule_samples(const struct learner *learner, struct learner_samples *contexts)
{
    int n = 0;

    for (int c = 0; c < LEARNER_MAX_SOLUTIONS; c++) {
        struct learner_samples samples = learner_kept_samples(learner, c);
        if (samples.n > 0)
            contexts[n++] = samples;
    }
    return n;
}

static int kept(const struct learner *learner)
{
    struct learner_samples contexts[LEARNER_MAX_SOLUTIONS];
    int n_contexts = body_schedule_samples(learner, contexts);
    int n = 0;

    for (int c = 0; c < n_contexts; c++)
        n += contexts[c].n;
    return n;
}

/* Also those that the mixture refused: they are kept for a body all the same. */
static uint64_t seen(const struct learner *learner)
{
    struct learner_statistics statistics = learner_get_statistics(learner);

    return statistics.samples + statistics.outliers + statistics.full;
}

bool body_schedule_due(const struct body_schedule *schedule, const struct learner *learner)
{
    if (learner_get_body_change(learner).unsettled)
        return false;
    return kept(learner) >= schedule->next_kept || seen(learner) >= schedule->next_learned;
}

void body_schedule_searched(struct body_schedule *schedule, const struct learner *learner)
{
    double more = learner_body(learner) ? more_refined : more_kept;
    double wanted = more * kept(learner);
    int next = (int)wanted + ((double)(int)wanted < wanted);

    if (next > schedule->next_kept)
        schedule->next_kept = next;
    schedule->next_learned = more_learned * seen(learner);
    if (!learner_body(learner) && schedule->next_learned < first_learned)
        schedule->next_learned = first_learned;
}
