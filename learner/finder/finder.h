/* Finds a robot's body from samples alone: no lengths, no axes, no URDF. docs/body.md.
 *
 * It solves nonlinear least squares with Ceres from many starts, takes up to seconds and allocates:
 * it belongs into a process of its own, never into the control loop, and is no part of the
 * learner's library. One call uses one thread. The same samples and settings give the same body. */
#ifndef REACH_LEARNER_FINDER_FINDER_H
#define REACH_LEARNER_FINDER_FINDER_H

#include "learner/body/body.h"
#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

struct finder_settings {
    int n_joints;
    bool sees;                  /* outputs are (yaw, pitch, disparity) of a head that fixates */
    double angle_unit;          /* of yaw and pitch, rad: 1, or pi / 180 */
    double noise[BODY_OUTPUTS]; /* standard deviation of a sample, as far as known */
    double
        gravity[BODY_OUTPUTS]; /* unit vector in the outputs' frame; of eyes along their yaw axis */
    int64_t seed;
    int starts;               /* at most so many random starts, >= 1 */
    const struct body *start; /* a body to begin with, or NULL */
};

enum finder_outcome {
    FINDER_FOUND,    /* `body` explains what was kept apart, and is sure enough */
    FINDER_NOT_YET,  /* too few samples, or too much alike */
    FINDER_NO_CHAIN, /* many samples, and no chain explains them */
};

struct finder_report {
    enum finder_outcome outcome;
    int samples;   /* used */
    int starts;    /* tried */
    double error;  /* of the best body over samples kept apart, rms, in units of settings.noise */
    double doubt;  /* rms standard deviation of its tip over the joints' range, of its length */
    char why[160]; /* one line */
};

/* Samples of n_contexts tools, those of each that differ in the joints (learner_kept_samples()).
 * Fills `body` when something was found, `report` always. */
enum finder_outcome finder_search(const struct finder_settings *settings,
                                  const struct learner_samples *contexts, int n_contexts,
                                  struct body *body, struct finder_report *report);

#ifdef __cplusplus
}
#endif
#endif
