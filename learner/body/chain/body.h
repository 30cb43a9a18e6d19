/* A body that was found: a chain of screws, the eyes that see its tip where there are any, how
 * noisy samples are, and how sure all of it is. The finder makes one (learner/finder); experts of a
 * learner with `experts: body` stand on it. docs/body.md. */
#ifndef REACH_LEARNER_BODY_CHAIN_BODY_H
#define REACH_LEARNER_BODY_CHAIN_BODY_H

#include <stdbool.h>

#include "learner/body/chain/chain.h"
#include "learner/body/chain/eyes.h"
#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Outputs of a body: a place in space, or what two eyes say of one. */
#define BODY_OUTPUTS 3
#define BODY_MAX_UNKNOWNS (CHAIN_MAX_UNKNOWNS + EYES_UNKNOWNS)

struct body {
    struct chain chain;
    bool sees; /* outputs are (yaw, pitch, disparity); otherwise a place */
    struct eyes eyes;
    double noise[BODY_OUTPUTS]; /* standard deviation of a sample, in the outputs' units */
    double length; /* how far places lie from their mean, rms: the measure of all priors */
    double gravity[BODY_OUTPUTS];   /* unit vector in the base's frame */
    double range[CHAIN_MAX_JOINTS]; /* half of what each joint was seen to go through, rad */
    /* Covariance L L' of the unknowns (the chain's, then the eyes'), L lower triangular, packed by
     * rows. Directions that no sample can tell (a point that moves along its axis) are left out. */
    double root[BODY_MAX_UNKNOWNS * (BODY_MAX_UNKNOWNS + 1) / 2];
    /* What the finder says of it. */
    int samples;  /* that it was found from */
    double error; /* rms over samples kept apart, in units of noise */
    double doubt; /* rms standard deviation of a place over `range`, or a tenth of that over what
                     the robot may use, of length */
};

/* Every field as a number, in the order above: for a saved state and for a message. */
#define BODY_NUMBERS                                                                               \
    (2 + 9 * CHAIN_MAX_JOINTS + 14 + 10 + BODY_MAX_UNKNOWNS * (BODY_MAX_UNKNOWNS + 1) / 2)
void body_to_numbers(const struct body *body, double *numbers);
/* What it holds is to be checked with body_check(). */
void body_from_numbers(const double *numbers, struct body *body);

/* The unknowns that `root` is of. */
int body_unknowns(const struct body *body);

/* 0 when every number is usable; otherwise -1 and a line in err. */
int body_check(const struct body *body, char *err, size_t err_size);

/* What was seen, in space: the place of x[3] in place[3], and in white[9] the matrix that turns a
 * small step in space into units of the noise of x. false for an x that the eyes cannot see. */
bool body_place(const struct body *body, const double *x, double *place, double *white);

/* From a place in space to the output x, begun at x; by_place[9] = d x / d place. false when the
 * eyes cannot look there. */
bool body_output(const struct body *body, const double *place, double *x, double *by_place);

/* covariance[9] += that of a tip in space (base's frame) at this pose for what is not known of the
 * chain, and of the eyes at x. */
void body_add_doubt(const struct body *body, const struct chain_pose *pose, const double *tip,
                    const double *x, double *covariance);

#ifdef __cplusplus
}
#endif
#endif
