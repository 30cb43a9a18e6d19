/* Looks for a body while a learner learns, and gives it what is found, in one process. When it
 * looks: learner/body/search/schedule.h. */
#ifndef REACH_LEARNER_FINDER_SEEKER_H
#define REACH_LEARNER_FINDER_SEEKER_H

#include "learner/body/search/schedule.h"
#include "learner/finder/finder.h"

#ifdef __cplusplus
extern "C" {
#endif

struct seeker {
    struct finder_settings settings;
    struct body_schedule schedule;
    int searches;
    int found;
    uint64_t found_at;           /* samples learned when the first body was found; 0: none yet */
    double found_seconds;        /* of the searches up to then */
    struct finder_report report; /* of the newest search */
    bool any_body;               /* `body` is one that a search came to */
    struct body body;
    double seconds; /* of all searches, this thread's processor time */
};

/* For a learner of this configuration, with LEARNER_BODY. */
void seeker_init(struct seeker *seeker, const struct learner_config *config);

/* After each sample. Returns whether the learner stands on another body now. */
bool seeker_look(struct seeker *seeker, struct learner *learner);

#ifdef __cplusplus
}
#endif
#endif
