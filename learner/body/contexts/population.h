/* Which contexts there are: what makes one more than a mistake, who goes when there is no room, and
 * who is not needed. For contexts.c alone. */
#ifndef REACH_LEARNER_BODY_CONTEXTS_POPULATION_H
#define REACH_LEARNER_BODY_CONTEXTS_POPULATION_H

#include "learner/body/contexts/contexts.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the newest sample counts of those that a context had of late. */
extern const double contexts_recent_share;

/* Context j knows nothing, but how long what it holds is: the place of the sample that was
 * whitened, from where the tip of what was learned first, the hand, is. */
void contexts_hold(struct contexts *contexts, int j);

/* The room at j is that of a new context, which has learned nothing of the sample yet. */
void contexts_begin(struct contexts *contexts, int j);

/* Whether this sample, which is context `winner`'s own, is one of many in a row that fit it badly:
 * each for itself is within what the context may err, all together are of another tool. */
bool contexts_strained(struct contexts *contexts, int winner);

/* The least distance among the sizes of a design that are still plausible. */
double contexts_distance_of(const struct context *context, const struct tied_fit *fit);

/* Confirms the context where what it has foretold is enough. */
void contexts_try(struct context *context);

/* With all that is known of it and of the newest sample. Contexts behind it move up. */
void contexts_remove_context(struct contexts *contexts, int j);

/* The newest context is on probation. */
void contexts_make_room_for_newest(struct contexts *contexts);

/* Context `newest` may have been confirmed just now, and stays; -1: none. */
void contexts_make_room_for_confirmed(struct contexts *contexts, int newest);

/* The newest sample was context `winner`'s. Who is not needed goes. Returns where the winner is. */
int contexts_tidy(struct contexts *contexts, int winner);

#ifdef __cplusplus
}
#endif
#endif
