/* The learner's inner loops, compiled once for each vector width; every width gives the same bits.
 *
 * How: elementwise work has no order to change, and sums have a fixed one, eight partial sums
 * (lanes) whatever the width, added up as ((0+4)+(2+6)) + ((1+5)+(3+7)). No fused multiply-add.
 * learner/kernels/kernels_body.h is the one source of all widths.
 *
 * Vectors need no alignment unless said. n counts numbers, and any n >= 0 is allowed. */
#ifndef REACH_LEARNER_KERNELS_KERNELS_H
#define REACH_LEARNER_KERNELS_KERNELS_H

#include <stdbool.h>
#include <stddef.h>

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { KERNEL_LANES = 8 };

struct kernels {
    /* sum a_i b_i */
    double (*dot)(int n, const double *a, const double *b);

    /* out[i] = sum_k rows[i * n + k] v[k] for `count` rows. */
    void (*apply)(int n, int count, const double *rows, const double *v, double *out);

    /* y += step x */
    void (*add)(int n, double step, const double *x, double *y);

    /* Squared lengths q = |root (z - nu)|^2 for n_blocks times 8 experts. A block holds d rows of 8
     * numbers (nu), then d (d + 1) / 2 such rows (root, lower triangular, by rows), one lane an
     * expert. block and q are aligned to 64 bytes. */
    void (*distances)(int d, int n_blocks, const double *block, const double *z, double *q);

    /* log_t[j] = log_norm[j] - exponent[j] log(1 + q[j] per_a[j]); n is a multiple of 8. */
    void (*log_student)(int n, const double *q, const double *per_a, const double *exponent,
                        const double *log_norm, double *log_t);

    /* Of 8 experts with few features. A block holds rows of 8 numbers, one lane an expert: phibar
     * (p), the whitener's packed rows, then for each output 1 / Psi, xbar and W (p); aligned to 64
     * bytes. leverage[8] = |G (phi - phibar)|^2. */
    void (*leverages)(int p, const double *block, const double *phi, double *leverage);

    /* The same experts' answers: xhat[i * 8] = xbar + W (phi - phibar), misfit[8] = sum (x -
     * xhat)^2 / Psi. */
    void (*regress)(int p, int n_outputs, const double *block, const double *phi, const double *x,
                    double *xhat, double *misfit);

    /* out = a + factor b; returns the largest. */
    double (*bounds)(int n, const double *a, double factor, const double *b, double *out);

    /* For a lower triangle G packed by rows: y = G v, and back = G' y. One pass over G. */
    void (*whiten)(int n, const double *G, const double *v, double *y, double *back);

    /* Row i of G becomes keep[i] G_i - take[i] s, and s grows by grow[i] times the old G_i, for all
     * rows from `first` on, a multiple of 8. s[n] starts at zero and is used up. One pass. */
    void (*rotate)(int n, int first, double *G, const double *keep, const double *take,
                   const double *grow, double *s);

    /* The three that follow take the eight columns from the diagonal on as a vector: up to 8
     * numbers behind G and v may be read, and behind G and back written with what they were. */

    /* y = G v for three vectors at once: v and y are three rows of n numbers, `stride` apart. */
    void (*whiten_three)(int n, size_t stride, const double *G, const double *v, double *y);

    /* As whiten(). */
    void (*solve)(int n, const double *G, const double *v, double *y, double *back);

    /* rotate() of all rows, `turns` times (3 or 4) in one pass: keep, take, grow and s are as many
     * rows of numbers, `stride` apart, a multiple of 8 and at least n. */
    void (*rotate_often)(int n, int turns, size_t stride, double *G, const double *keep,
                         const double *take, const double *grow, double *s);

    /* Clustering of answers; n is a multiple of 8, and weights are zero where there is no answer.
     * deviation[a] = sum_i (x[i][a] - center[i])^2 weight[i][a], rows of x and weight `stride`
     * apart; nearest[a] falls to it where it is smaller. */
    void (*deviations)(int n, int n_outputs, size_t stride, const double *x, const double *weight,
                       const double *center, double *deviation, double *nearest);

    /* p holds deviations, and becomes p[a] = exp(-(p[a] - nearest[a]) / 2); sum[a] += p[a]. */
    void (*memberships)(int n, double *p, const double *nearest, double *sum);

    /* p[a] /= sum[a] */
    void (*normalise)(int n, double *p, const double *sum);

    /* *top = sum_a p[a] weight[a] x[a], *bottom = the same without x. */
    void (*weighted_sums)(int n, const double *p, const double *weight, const double *x,
                          double *top, double *bottom);
};

/* The kernels of a width; for KERNELS_AUTO the widest that this machine has. NULL when the machine
 * or the build lacks it. */
const struct kernels *kernels_of(enum learner_kernels width);

#ifdef __cplusplus
}
#endif
#endif
