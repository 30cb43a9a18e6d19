/* A chain of screws in Denavit's and Hartenberg's four numbers a joint (the classic form, frame i
 * at the far end of link i):
 *
 *   T_i = Rot(z, theta_i + q_i) Trans(z, d_i) Trans(x, a_i) Rot(x, alpha_i)
 *
 * of a joint that turns; one that slides adds q_i to d_i. */
#ifndef REACH_TOOLS_REACHCTL_BODY_DH_H
#define REACH_TOOLS_REACHCTL_BODY_DH_H

#include "learner/body/chain/chain.h"

struct dh_row {
    double theta, d, a, alpha; /* rad, and the chain's unit of length */
};

struct dh {
    int n;
    double
        base[12]; /* frame 0 in the base's frame: x, y, z axes and the origin, three numbers each */
    struct dh_row row[CHAIN_MAX_JOINTS];
};

/* The same motion in these numbers. Frame n lies in the last joint's axis, where the last link's
 * frame of the chain has no place of its own either. */
void dh_of_chain(const struct chain *chain, struct dh *dh);

#endif
