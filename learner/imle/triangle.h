/* Small lower triangular matrices packed by columns, and Cholesky factors in them: what the inverse
 * prediction solves with (for what is carried from sample to sample see imle/whitener.h). Column j
 * holds the entries (j,j) .. (n-1,j), one after the other. */
#ifndef REACH_LEARNER_IMLE_TRIANGLE_H
#define REACH_LEARNER_IMLE_TRIANGLE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Numbers in a packed triangle of order n. */
static inline size_t triangle_size(int n)
{
    return (size_t)n * ((size_t)n + 1) / 2;
}

/* Where column j begins. */
static inline size_t triangle_column(int n, int j)
{
    return (size_t)j * (size_t)n - (size_t)j * ((size_t)j - 1) / 2;
}

/* sum a_i b_i in four fixed lanes: the same bits whatever the compiler makes of it. */
double triangle_dot(int n, const double *a, const double *b);

/* L = diag(value). */
void triangle_set_diagonal(int n, double *L, double value);

/* y := L^-1 y */
void triangle_solve(int n, const double *L, double *y);

/* y := L'^-1 y */
void triangle_solve_transposed(int n, const double *L, double *y);

/* The packed triangle of C, positive definite, becomes that of its factor L. Returns 0, or -1 when
 * C is not positive definite (the triangle is then spoiled). */
int triangle_factor(int n, double *C);

/* L becomes L^-1, triangular too. */
void triangle_invert(int n, double *L);

#ifdef __cplusplus
}
#endif
#endif
