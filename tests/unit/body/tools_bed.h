/* A learner on a made-up arm's body, and tools for its hand. The arm has JOINTS joints. */
#ifndef REACH_TEST_BODY_TOOLS_BED_H
#define REACH_TEST_BODY_TOOLS_BED_H

#include "made_up_arm.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { JOINTS = 5 };

struct learner *on_body(const struct body *body, int capacity);

void random_tip(double *tip);

/* Samples at random postures; none is refused. */
void teach(struct learner *learner, const struct body *body, const double *tip, int samples);

int experts(const struct learner *learner);

/* How far the nearest of all solutions is from x, squared, a coordinate, in units of the noise. */
double nearest_square(const struct learner_prediction *prediction, const struct body *body,
                      const double *x);

/* In units of the noise, over random postures: how far the nearest of all solutions is, rms. */
double misfit(struct learner *learner, const struct body *body, const double *tip);

#ifdef __cplusplus
}
#endif
#endif
