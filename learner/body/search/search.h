/* What a finder of bodies is told and what it answers. The finder itself is a program of its own
 * (learner/finder): whoever asks it needs no more than this. */
#ifndef REACH_LEARNER_BODY_SEARCH_SEARCH_H
#define REACH_LEARNER_BODY_SEARCH_SEARCH_H

#include "learner/body/chain/body.h"
#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

struct finder_settings {
    int n_joints;
    bool sees;                  /* outputs are (yaw, pitch, disparity) of a head that fixates */
    double angle_unit;          /* of yaw and pitch, rad: 1, or pi / 180 */
    double noise[BODY_OUTPUTS]; /* standard deviation of a sample, as far as known */
    /* Of each joint what the robot may use, rad: a body is to be sure there, and where samples are.
     * low >= high: not known, so where samples are. */
    double low[LEARNER_MAX_INPUTS], high[LEARNER_MAX_INPUTS];
    /* Unit vector in the outputs' frame; of eyes along their yaw axis. */
    double gravity[BODY_OUTPUTS];
    int64_t seed;
    int starts;               /* at most so many random starts, >= 1 */
    const struct body *start; /* a body to begin with, or NULL */
};

/* For a learner of this configuration, with LEARNER_BODY; seed 0, no start. */
struct finder_settings finder_settings_of(const struct learner_config *config);

/* Values are those of body_t.outcome. */
enum finder_outcome {
    FINDER_FOUND,       /* `body` explains what was kept apart, and is sure enough */
    FINDER_NOT_YET,     /* too few samples, or too much alike */
    FINDER_NO_CHAIN,    /* many samples, and no chain explains them */
    FINDER_REFUTED = 5, /* the body that it began with is none: it was believed, explains the
                           samples no more, and no other is sure enough */
};

struct finder_report {
    enum finder_outcome outcome;
    int samples;   /* used */
    int starts;    /* tried */
    double error;  /* of the best body over samples kept apart, rms, in units of settings.noise */
    double doubt;  /* rms standard deviation of its tip over the joints' range seen, or a tenth of
                      that over what the robot may use, of its length; or how far a rival is */
    char why[160]; /* one line */
    /* There is a body: the one that was found, or one that explains the samples and is not sure
     * enough, with which the next search may begin. */
    bool any_body;
};

#ifdef __cplusplus
}
#endif
#endif
