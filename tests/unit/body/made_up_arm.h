/* An arm that no robot has: random axes and offsets, a body that says so, and what it would see. */
#ifndef REACH_TEST_BODY_MADE_UP_ARM_H
#define REACH_TEST_BODY_MADE_UP_ARM_H

#include "learner/body/chain/body.h"
#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Standard deviation of a sample: m, or of an arm that eyes see rad, rad, px. */
#define ARM_NOISE 0.0005
#define ARM_NOISE_ANGLE 0.0005
#define ARM_NOISE_DISPARITY 0.2

/* Numbers from bed_seed()'s source. */
void random_unit(double v[3]);
void random_joints(const struct body *body, double *z);

/* Links of some 20 cm, joints that go through +-1.2 rad, known to a tenth of a millimetre. With
 * `sees`, two eyes look at its tip from 70 cm. */
struct body made_up_arm(int n_joints, bool sees);

/* Where a tip (m, in the last frame) is at z, without noise. false where the eyes cannot see it. */
bool arm_output(const struct body *body, const double *tip, const double *z, double *x);

/* The same as it is measured. */
bool arm_sample(const struct body *body, const double *tip, const double *z, double *x);

/* A learner with experts: body of so many inputs, of places or, with `sees`, of eyes, and of at
 * most `capacity` contexts. */
struct learner_config body_config(int n_inputs, bool sees, int capacity);

#ifdef __cplusplus
}
#endif
#endif
