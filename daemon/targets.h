/* What the two behaviours with a list of targets share: getting the marker into fixation first,
 * then one target after another, each for its time. */
#ifndef REACH_TARGETS_H
#define REACH_TARGETS_H

#include "behaviour.h"

/* Copies the request's targets and enters the first phase. */
void targets_start(struct behaviour *behaviour, const reach_request_t *request,
                   struct control *control);

/* The phases before the first target: the arm to the middle of the babbled range when asked for,
 * then fixation, from where equation 14 starts. Returns true in the tick in which it is done. */
bool targets_prepare(struct behaviour *behaviour, struct control *control);

/* The target of this tick, which is also the next tick's until its time is over.
 * `is_new` tells that it was just presented. Returns NULL when all had their time. */
const double *targets_current(struct behaviour *behaviour, struct control *control, bool *is_new);

/* The marker was lost for too long: back to fixation, then on with the present target. */
void targets_refixate(struct behaviour *behaviour);

#endif
