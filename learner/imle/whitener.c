/* Adding to C. With a = sqrt(weight / delta) y and I + a a' = M M', the new whitener is M^-1 G /
 * sqrt(delta). M^-1 is known in closed form: for tau_i = 1 + a_0^2 + .. + a_i^2 its row i is
 *   sqrt(tau_(i-1) / tau_i) (e_i - a_i / tau_(i-1) sum_(k<i) a_k e_k)
 * so that one sum of rows, carried along, serves them all (the idea of P. Gill, G. Golub, W.
 * Murray, M. Saunders, "Methods for modifying matrix factorizations", 1974). */
#include "learner/imle/whitener.h"

#include <math.h>
#include <string.h>

#include "common/base/elementary.h"

/* Products of this many diagonal entries stay within a double's range. */
enum { FACTORS = 8 };

void whitener_set_diagonal(int n, double *G, double variance)
{
    memset(G, 0, whitener_row(n) * sizeof *G);
    for (int i = 0; i < n; i++)
        G[whitener_row(i) + (size_t)i] = 1.0 / sqrt(variance);
}

void whitener_add(const struct kernels *kernels, int n, int zeros, double *G, double delta,
                  double weight, const double *y, const struct whitener_scratch *scratch)
{
    int first = delta == 1.0 ? zeros / KERNEL_LANES * KERNEL_LANES : 0;
    double root = sqrt(weight / delta);
    double tau = 1.0;

    for (int i = first; i < n; i++) {
        double a = root * y[i];
        double next = tau + a * a;
        scratch->keep[i] = sqrt(tau / (next * delta));
        scratch->take[i] = scratch->keep[i] * a / tau;
        scratch->grow[i] = a;
        tau = next;
    }
    memset(scratch->sum, 0, (size_t)n * sizeof *scratch->sum);
    kernels->rotate(n, first, G, scratch->keep, scratch->take, scratch->grow, scratch->sum);
}

double whitener_log_det(int n, const double *G)
{
    double sum = 0.0;

    for (int begin = 0; begin < n; begin += FACTORS) {
        int end = begin + FACTORS < n ? begin + FACTORS : n;
        double product = 1.0;
        for (int i = begin; i < end; i++)
            product *= G[whitener_row(i) + (size_t)i];
        sum += elementary_log(product);
    }
    return sum;
}
