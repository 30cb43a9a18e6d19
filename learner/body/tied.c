#include "learner/body/tied.h"

#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/vec3.h"

/* By how much the evidence of a larger size must exceed a smaller one's: prior odds of e^-4. */
static const double convincing = 4.0;
/* What evidence of before still counts: some thousand samples. */
static const double evidence_kept = 0.999;

size_t tied_numbers(const struct design *design)
{
    size_t P = (size_t)design->size[2];

    return whitener_row(design->size[2]) + (1 + DESIGN_SIZES) * P;
}

size_t tied_scratch_numbers(const struct design *design)
{
    return 8 * (size_t)design->size[2];
}

void tied_place(struct tied *tied, const struct design *design, double *numbers)
{
    size_t P = (size_t)design->size[2];

    tied->G = numbers;
    tied->b = numbers + whitener_row(design->size[2]);
    for (size_t k = 0; k < DESIGN_SIZES; k++)
        tied->theta[k] = tied->b + (1 + k) * P;
}

void tied_place_scratch(struct tied_scratch *scratch, const struct design *design, double *numbers)
{
    size_t P = (size_t)design->size[2];

    for (size_t row = 0; row < 3; row++)
        scratch->y[row] = numbers + row * P;
    scratch->back = numbers + 3 * P;
    scratch->add = (struct whitener_scratch){numbers + 4 * P, numbers + 5 * P, numbers + 6 * P,
                                             numbers + 7 * P};
}

void tied_reset(struct tied *tied, const struct design *design)
{
    size_t P = (size_t)design->size[2];

    whitener_set_diagonal(design->size[2], tied->G, 1.0);
    memset(tied->b, 0, (1 + DESIGN_SIZES) * P * sizeof *tied->b);
    memset(tied->evidence, 0, sizeof tied->evidence);
    tied->turn = 0.0;
    tied->chosen = 0;
}

/* G times the first n numbers of each row. */
static void whiten_rows(const struct tied *tied, const struct design *design, int n,
                        const struct kernels *kernels, const double *rows,
                        struct tied_scratch *scratch)
{
    for (int row = 0; row < 3; row++)
        kernels->whiten(n, tied->G, rows + (ptrdiff_t)row * design->size[2], scratch->y[row],
                        scratch->back);
}

/* S = I + Phi C^-1 Phi' of a size, by its Cholesky factor L (lower, in place). */
static void factor(double *S)
{
    S[0] = sqrt(S[0]);
    S[3] /= S[0];
    S[6] /= S[0];
    S[4] = sqrt(S[4] - S[3] * S[3]);
    S[7] = (S[7] - S[6] * S[3]) / S[4];
    S[8] = sqrt(S[8] - S[6] * S[6] - S[7] * S[7]);
}

static double distance_by(const double *L, const double *e)
{
    double a = e[0] / L[0];
    double b = (e[1] - L[3] * a) / L[4];
    double c = (e[2] - L[6] * a - L[7] * b) / L[8];

    return a * a + b * b + c * c;
}

static double log_density(const double *L, double distance)
{
    return -0.5 * distance - elementary_log(L[0] * L[4] * L[8]);
}

void tied_test(const struct tied *tied, const struct design *design, const struct kernels *kernels,
               const double *rows, const double *y, const double *doubt,
               struct tied_scratch *scratch, struct tied_fit *fit)
{
    whiten_rows(tied, design, design->size[2], kernels, rows, scratch);
    for (int k = 0; k < DESIGN_SIZES; k++) {
        double S[9] = {0};
        double with_doubt[9];
        double e[3];
        for (int r = 0; r < 3; r++) {
            e[r] = y[r] - kernels->dot(design->size[k], rows + (ptrdiff_t)r * design->size[2],
                                       tied->theta[k]);
            for (int s = 0; s <= r; s++)
                S[3 * r + s] = kernels->dot(design->size[k], scratch->y[r], scratch->y[s]) +
                               (r == s ? 1.0 : 0.0);
        }
        for (int i = 0; i < 9; i++)
            with_doubt[i] = S[i] + doubt[i];
        factor(with_doubt);
        fit->distance[k] = distance_by(with_doubt, e);
        fit->log_density[k] = log_density(with_doubt, fit->distance[k]);
        factor(S);
        fit->log_evidence[k] = log_density(S, distance_by(S, e));
    }
}

void tied_refresh(struct tied *tied, const struct design *design, const struct kernels *kernels,
                  struct tied_scratch *scratch)
{
    for (int k = 0; k < DESIGN_SIZES; k++)
        kernels->whiten(design->size[k], tied->G, tied->b, scratch->back, tied->theta[k]);
}

/* A coefficient in turn gets back what forgetting took of its prior. */
static void top_up(struct tied *tied, const struct design *design, const struct kernels *kernels,
                   double keep, struct tied_scratch *scratch)
{
    int P = design->size[2];
    int i = (int)tied->turn;

    memset(scratch->y[0], 0, (size_t)P * sizeof(double));
    for (int row = i; row < P; row++)
        scratch->y[0][row] = tied->G[whitener_row(row) + (size_t)i];
    whitener_add(kernels, P, i, tied->G, 1.0, P * (1.0 - keep), scratch->y[0], &scratch->add);
    tied->turn = i + 1 < P ? i + 1 : 0;
}

static void choose(struct tied *tied)
{
    tied->chosen = 0;
    for (int k = 1; k < DESIGN_SIZES; k++)
        if (tied->evidence[k] > tied->evidence[tied->chosen] + convincing)
            tied->chosen = k;
}

void tied_learn(struct tied *tied, const struct design *design, const struct kernels *kernels,
                const double *rows, const double *y, double h, double keep,
                struct tied_scratch *scratch, const struct tied_fit *fit)
{
    int P = design->size[2];

    for (int k = 0; k < DESIGN_SIZES; k++)
        tied->evidence[k] = evidence_kept * tied->evidence[k] + h * fit->log_density[k];
    for (int i = 0; i < P && keep < 1.0; i++)
        tied->b[i] *= keep;
    for (int row = 0; row < 3; row++) {
        const double *v = rows + (ptrdiff_t)row * P;
        kernels->whiten(P, tied->G, v, scratch->y[0], scratch->back);
        whitener_add(kernels, P, 0, tied->G, row == 0 ? keep : 1.0, h, scratch->y[0],
                     &scratch->add);
        kernels->add(P, h * y[row], v, tied->b);
    }
    if (keep < 1.0)
        top_up(tied, design, kernels, keep, scratch);
    tied_refresh(tied, design, kernels, scratch);
    choose(tied);
}

void tied_add_doubt(const struct tied *tied, const struct design *design,
                    const struct kernels *kernels, const double *rows, struct tied_scratch *scratch,
                    double *covariance)
{
    int n = design->size[tied->chosen];

    whiten_rows(tied, design, n, kernels, rows, scratch);
    for (int r = 0; r < 3; r++)
        for (int s = 0; s < 3; s++)
            covariance[3 * r + s] += kernels->dot(n, scratch->y[r], scratch->y[s]);
}
