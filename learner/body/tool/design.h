/* What an expert on a body is linear in: a tip, what it gives way to gravity, and what no chain
 * explains.
 *
 *   place - p(q) = R (o + A (R' g)) + B phi(q) = Phi(q) theta
 *
 * theta holds o (3), A (9, row by row) and B (3 rows of monomials up to the second degree of the
 * joints over `range`), in this order, each in units of its prior's standard deviation, so that the
 * prior of every coefficient is N(0, 1); that of A knows more once there is a tip. All rows of Phi
 * share theta. Three nested sizes of it are weighed against each other: a rigid tip is ruined by
 * coefficients that it does not need. */
#ifndef REACH_LEARNER_BODY_TOOL_DESIGN_H
#define REACH_LEARNER_BODY_TOOL_DESIGN_H

#include "learner/body/chain/body.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { DESIGN_TIP = 3, DESIGN_DROOP = 9, DESIGN_SIZES = 3 };
/* Most coefficients: more would not fit a control tick. Joints beyond have a linear remainder. */
#define DESIGN_MAX 256

struct design {
    int n_joints;
    int degree;                     /* of the remainder */
    int size[DESIGN_SIZES];         /* coefficients of the tip; with droop; with the remainder */
    double range[CHAIN_MAX_JOINTS]; /* rad */
    double sd_tip, sd_droop, sd_constant, sd_linear,
        sd_quadratic;         /* of the body's unit of length */
    double sd_across, sd_odd; /* of c, and of each number of A beside it */
    double stub;              /* a tip that is as near to the last axis has no direction yet */
};

void design_init(struct design *design, const struct body *body);

/* Phi[3 * size[2]], row by row, at this pose. */
void design_rows(const struct design *design, const struct body *body,
                 const struct chain_pose *pose, double *rows);

/* What a tool whose tip is at tip[3] in the last frame (length, not theta) is thought to give way
 * by: covariance[9 * 9] of the coefficients of A, row by row. What is long bends across itself, by
 * as much in every direction across, A = c (I - o o' / |o|^2); by little in any other way. */
void design_droop_prior(const struct design *design, const double *tip, double *covariance);

/* d (Phi theta) / d q for the first `size` coefficients: 3 x n_joints, row by row. */
void design_slope(const struct design *design, const struct body *body,
                  const struct chain_pose *pose, int size, const double *theta, double *slope);

#ifdef __cplusplus
}
#endif
#endif
