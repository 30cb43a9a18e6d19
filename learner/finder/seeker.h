/* Looks for a body while a learner learns, and gives it what is found. When it looks depends on
 * samples alone, never on time, so that the same samples give the same learner. */
#ifndef REACH_LEARNER_FINDER_SEEKER_H
#define REACH_LEARNER_FINDER_SEEKER_H

#include "learner/finder/finder.h"

#ifdef __cplusplus
extern "C" {
#endif

struct seeker {
    struct finder_settings settings;
    int next_kept;         /* samples that differ, with which the next search is due */
    uint64_t next_learned; /* samples learned, the same */
    int searches;
    int found;
    uint64_t found_at;           /* samples learned when the first body was found; 0: none yet */
    double found_seconds;        /* of the searches up to then */
    struct finder_report report; /* of the newest search */
    double seconds;              /* of all searches, this thread's processor time */
};

/* For a learner of this configuration, with LEARNER_BODY. */
void seeker_init(struct seeker *seeker, const struct learner_config *config);

/* After each sample. Returns whether the learner stands on another body now. */
bool seeker_look(struct seeker *seeker, struct learner *learner);

#ifdef __cplusplus
}
#endif
#endif
