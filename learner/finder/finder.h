/* Finds a robot's body from samples alone: no lengths, no axes, no URDF. docs/body.md.
 *
 * It solves nonlinear least squares with Ceres from many starts, takes up to seconds and allocates:
 * it belongs into a process of its own, never into the control loop, and is no part of the
 * learner's library. One call uses one thread. The same samples and settings give the same body. */
#ifndef REACH_LEARNER_FINDER_FINDER_H
#define REACH_LEARNER_FINDER_FINDER_H

#include "learner/body/search/search.h"
#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Samples of n_contexts tools, those of each that differ in the joints (learner_kept_samples()).
 * Fills `body` when the report says so, and always the report. */
enum finder_outcome finder_search(const struct finder_settings *settings,
                                  const struct learner_samples *contexts, int n_contexts,
                                  struct body *body, struct finder_report *report);

#ifdef __cplusplus
}
#endif
#endif
