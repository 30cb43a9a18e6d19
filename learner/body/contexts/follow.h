/* How contexts follow a body that changes: each remembers its tip (change.h), and when one cause
 * explains what samples differ from that by, the body is corrected. Tools that were not in use keep
 * their tips: what was learned of them, and the samples kept, are those of a joint that turns from
 * its old zero, so they are rewritten by the same number. For contexts.c alone. */
#ifndef REACH_LEARNER_BODY_CONTEXTS_FOLLOW_H
#define REACH_LEARNER_BODY_CONTEXTS_FOLLOW_H

#include "learner/body/contexts/contexts.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A sample, whitened and tested, that context `winner` explains; -1: a new one was born of it. To
 * be called before it is learned. */
void follow_sample(struct contexts *contexts, int winner, const double *x, const double *y);

/* Looks, once in a while, whether something has changed, and corrects the body. True when it did:
 * contexts of samples that were not understood before are gone. */
bool follow_look(struct contexts *contexts);

/* Samples of late were not understood, and it is not yet decided of what they are. */
bool follow_unsettled(const struct contexts *contexts);

/* Before another body comes: whether a context is to be learned anew on the old one first, since
 * its tip is on its way and what it remembers must come along; and that it was. */
bool follow_leaves(struct context *context);
void follow_left(struct context *context);

/* It was learned anew on the new body. */
void follow_relearned(struct contexts *contexts, struct context *context);

/* correct.c. For follow.c alone: samples of its own that a context must have to speak; what y
 * leaves of the remembered tip; all samples are understood again; and the body is corrected by the
 * story, with which the newest samples are context `astray`'s (-1: none was astray). */
extern const double follow_fewest_own;
void follow_left_of(const struct contexts *contexts, const struct anchor *anchor, const double *y,
                    double *left);
void follow_end_streak(struct contexts *contexts);
void follow_correct(struct contexts *contexts, int astray, const struct change_story *story);

#ifdef __cplusplus
}
#endif
#endif
