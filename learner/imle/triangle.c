#include "learner/imle/triangle.h"

#include <math.h>
#include <string.h>

double triangle_dot(int n, const double *a, const double *b)
{
    double lane[4] = {0.0, 0.0, 0.0, 0.0};
    int i = 0;

    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; k++)
            lane[k] += a[i + k] * b[i + k];
    for (; i < n; i++)
        lane[i % 4] += a[i] * b[i];
    return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

void triangle_set_diagonal(int n, double *L, double value)
{
    memset(L, 0, triangle_size(n) * sizeof *L);
    for (int j = 0; j < n; j++)
        L[triangle_column(n, j)] = value;
}

void triangle_solve(int n, const double *L, double *y)
{
    for (int j = 0; j < n; j++) {
        const double *column = L + triangle_column(n, j);
        double value = y[j] / column[0];
        y[j] = value;
        for (int i = 1; i < n - j; i++)
            y[j + i] -= column[i] * value;
    }
}

void triangle_solve_transposed(int n, const double *L, double *y)
{
    for (int j = n - 1; j >= 0; j--) {
        const double *column = L + triangle_column(n, j);
        y[j] = (y[j] - triangle_dot(n - j - 1, column + 1, y + j + 1)) / column[0];
    }
}

/* Right-looking: each finished column is taken off the triangle that is left. */
int triangle_factor(int n, double *C)
{
    for (int j = 0; j < n; j++) {
        double *column = C + triangle_column(n, j);
        if (!(column[0] > 0.0) || !isfinite(column[0]))
            return -1;
        column[0] = sqrt(column[0]);
        for (int i = 1; i < n - j; i++)
            column[i] /= column[0];
        for (int k = 1; k < n - j; k++) {
            double *later = C + triangle_column(n, j + k);
            for (int i = k; i < n - j; i++)
                later[i - k] -= column[i] * column[k];
        }
    }
    return 0;
}

/* Column j of the inverse solves L y = e_j; columns to the right are not needed any more when the
 * work goes from the last column to the first. */
void triangle_invert(int n, double *L)
{
    for (int j = n - 1; j >= 0; j--) {
        double *column = L + triangle_column(n, j);
        double inverse = 1.0 / column[0];
        column[0] = inverse;
        /* Below the diagonal: -(inverse of the lower right block) * column * inverse. */
        for (int i = n - j - 1; i >= 1; i--) {
            double sum = 0.0;
            for (int k = 1; k <= i; k++)
                sum += L[triangle_column(n, j + k) + (size_t)(i - k)] * column[k];
            column[i] = -sum * inverse;
        }
    }
}
