/* Vectors of three numbers, and 3 x 3 matrices row by row. */
#ifndef REACH_LEARNER_BODY_CHAIN_VEC3_H
#define REACH_LEARNER_BODY_CHAIN_VEC3_H

#include <math.h>
#include <stddef.h>

static inline double vec3_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double vec3_length(const double *a)
{
    return sqrt(vec3_dot(a, a));
}

/* y += step a */
static inline void vec3_add(double step, const double *a, double *y)
{
    for (int i = 0; i < 3; i++)
        y[i] += step * a[i];
}

/* y = a x b; y is neither of them. */
static inline void vec3_cross(const double *a, const double *b, double *y)
{
    y[0] = a[1] * b[2] - a[2] * b[1];
    y[1] = a[2] * b[0] - a[0] * b[2];
    y[2] = a[0] * b[1] - a[1] * b[0];
}

/* y = M v; y is not v. */
static inline void mat3_apply(const double *M, const double *v, double *y)
{
    for (int i = 0; i < 3; i++)
        y[i] = vec3_dot(M + (ptrdiff_t)3 * i, v);
}

/* y = M' v; y is not v. */
static inline void mat3_apply_transposed(const double *M, const double *v, double *y)
{
    for (int i = 0; i < 3; i++)
        y[i] = M[i] * v[0] + M[3 + i] * v[1] + M[6 + i] * v[2];
}

/* C = A B; C is neither of them. */
static inline void mat3_multiply(const double *A, const double *B, double *C)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            C[3 * i + k] = A[3 * i] * B[k] + A[3 * i + 1] * B[3 + k] + A[3 * i + 2] * B[6 + k];
}

/* The inverse of M, whose determinant is returned; where that is 0 the inverse is not finite. */
static inline double mat3_invert(const double *M, double *inverse)
{
    double rows[9];

    vec3_cross(M + 3, M + 6, rows);
    vec3_cross(M + 6, M, rows + 3);
    vec3_cross(M, M + 3, rows + 6);
    double determinant = vec3_dot(M, rows);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            inverse[3 * i + k] = rows[3 * k + i] / determinant;
    return determinant;
}

#endif
