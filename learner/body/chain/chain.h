/* A serial arm as a chain of screws: where the frame is that a tool sits in.
 *
 *   p(q) = t_1 + E_1 (t_2 + E_2 (... t_n)),   R(q) = E_1 ... E_n
 *
 * E_i turns by q_i - middle_i about axis_i, |axis_i| = 1, or slides along it (then E_i shifts and
 * does not turn). p lies on the last joint's axis; a tip o in the frame behind it is at p + R o.
 * All vectors are given in the frame of the joint before, at middle; units are those of the task
 * space (m, or the eyes' own unit), angles rad. */
#ifndef REACH_LEARNER_BODY_CHAIN_CHAIN_H
#define REACH_LEARNER_BODY_CHAIN_CHAIN_H

#include <stdbool.h>

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CHAIN_MAX_JOINTS LEARNER_MAX_INPUTS
/* Unknowns of a chain: an axis and an offset a joint, in this order: all axes, all offsets. */
#define CHAIN_MAX_UNKNOWNS (6 * CHAIN_MAX_JOINTS)

struct chain {
    int n; /* joints, 1 .. CHAIN_MAX_JOINTS */
    bool slides[CHAIN_MAX_JOINTS];
    double middle[CHAIN_MAX_JOINTS];    /* rad, or m of one that slides */
    double axis[CHAIN_MAX_JOINTS][3];   /* unit vectors */
    double offset[CHAIN_MAX_JOINTS][3]; /* t_i: from the joint before */
};

/* The chain at one posture. Matrices are 3 x 3, row by row. */
struct chain_pose {
    double moved[CHAIN_MAX_JOINTS];       /* q - middle */
    double turn[CHAIN_MAX_JOINTS + 1][9]; /* E_1 ... E_i, turned parts; turn[n] is R */
    double axis[CHAIN_MAX_JOINTS][3];     /* joint i's axis in the base's frame */
    double place[CHAIN_MAX_JOINTS][3];    /* a point on it */
    double p[3];
};

/* The chain at the joints q[n]. */
void chain_at(const struct chain *chain, const double *q, struct chain_pose *pose);

/* d tip / d q: 3 x n, row by row, for a tip (base's frame) that moves with the last frame. */
void chain_jacobian(const struct chain *chain, const struct chain_pose *pose, const double *tip,
                    double *jacobian);

/* d tip / d unknowns: 3 x 6 n, row by row. An axis counts as axis / |axis| of three free numbers.
 */
void chain_slope(const struct chain *chain, const struct chain_pose *pose, const double *tip,
                 double *slope);

#ifdef __cplusplus
}
#endif
#endif
