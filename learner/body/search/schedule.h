/* When the next search for a body is due: a function of samples alone, never of time, so that the
 * same samples give the same learner. */
#ifndef REACH_LEARNER_BODY_SEARCH_SCHEDULE_H
#define REACH_LEARNER_BODY_SEARCH_SCHEDULE_H

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

struct body_schedule {
    int next_kept;         /* samples that differ, with which the next search is due */
    uint64_t next_learned; /* samples learned, the same */
};

/* Of a learner that knows nothing yet. */
struct body_schedule body_schedule_begin(void);

/* Whether a search is due with the samples that the learner has now. Not while it may be that the
 * body has changed: samples of before and after make no body. */
bool body_schedule_due(const struct body_schedule *schedule, const struct learner *learner);

/* A search has those samples: the next is due when there are enough more. Also for a learner that
 * was loaded, as if it had just been searched. */
void body_schedule_searched(struct body_schedule *schedule, const struct learner *learner);

/* The samples to search in: of every context that has any, at most LEARNER_MAX_SOLUTIONS. Returns
 * how many those are. They hold until the learner's next update. */
int body_schedule_samples(const struct learner *learner, struct learner_samples *contexts);

#ifdef __cplusplus
}
#endif
#endif
