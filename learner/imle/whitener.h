/* The whitener G of a positive definite C: lower triangular with G C G' = I, so that C^-1 = G' G.
 *
 * Carried instead of C or its Cholesky factor, because everything wanted of C is then a product:
 *   y = G v,   v' C^-1 v = |y|^2,   C^-1 v = G' y
 * without a division, in one pass over G's bytes. One more pass adds a sample to C.
 *
 * Packed by rows: row i holds entries (i, 0) .. (i, i). So the first k (k + 1) / 2 numbers are the
 * whitener of the first k coordinates alone, and a coordinate more is a row more. */
#ifndef REACH_LEARNER_IMLE_WHITENER_H
#define REACH_LEARNER_IMLE_WHITENER_H

#include "learner/kernels/kernels.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Scratch for one call; n numbers each. */
struct whitener_scratch {
    double *keep;
    double *take;
    double *grow;
    double *sum;
};

/* Where row i begins; row n is the size of a whitener of order n. */
static inline size_t whitener_row(int i)
{
    return (size_t)i * ((size_t)i + 1) / 2;
}

/* G of C = variance on the diagonal, zero elsewhere. */
void whitener_set_diagonal(int n, double *G, double variance);

/* C becomes delta C + weight v v', with y = G v; delta > 0, weight >= 0. The first `zeros` numbers
 * of y are known to be zero: rows before are only scaled. Adds positive terms only, so the diagonal
 * of G stays positive however long it goes on. O(n^2). */
void whitener_add(const struct kernels *kernels, int n, int zeros, double *G, double delta,
                  double weight, const double *y, const struct whitener_scratch *scratch);

/* log det G: 1/2 log det C^-1. */
double whitener_log_det(int n, const double *G);

#ifdef __cplusplus
}
#endif
#endif
