#include "learner/body/tool/tied.h"

#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/chain/vec3.h"

/* By how much the evidence of a larger size must exceed a smaller one's: prior odds of e^-4. */
static const double convincing = 4.0;
/* What evidence of before still counts: some thousand samples. */
static const double evidence_kept = 0.999;
/* Additions to C that one sample makes: its three rows, and what tops a prior up. */
enum { TURNS = 4 };

size_t tied_numbers(const struct design *design)
{
    size_t P = (size_t)design->size[2];

    return whitener_row(design->size[2]) + (1 + DESIGN_SIZES) * P;
}

/* A row of rotate_often(). */
static size_t stride_of(const struct design *design)
{
    return ((size_t)design->size[2] + KERNEL_LANES - 1) / KERNEL_LANES * KERNEL_LANES;
}

size_t tied_scratch_numbers(const struct design *design)
{
    return 4 * (size_t)design->size[2] + 4 * TURNS * stride_of(design);
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
    size_t stride = stride_of(design);
    double *turns = numbers + 4 * P;

    *scratch = (struct tied_scratch){
        .y = numbers,
        .back = numbers + 3 * P,
        .keep = turns,
        .take = turns + TURNS * stride,
        .grow = turns + 2 * TURNS * stride,
        .sum = turns + 3 * TURNS * stride,
        .stride = stride,
    };
}

/* G of the droop's coefficients, with G' G their covariance: from the last row up. */
static void whiten_droop(const double *covariance, double *G)
{
    enum { N = DESIGN_DROOP };

    for (int i = N - 1; i >= 0; i--) {
        double *row = G + whitener_row(DESIGN_TIP + i) + DESIGN_TIP;
        for (int j = i; j >= 0; j--) {
            double left = covariance[N * i + j];
            for (int k = i + 1; k < N; k++) {
                const double *below = G + whitener_row(DESIGN_TIP + k) + DESIGN_TIP;
                left -= below[i] * below[j];
            }
            row[j] = j == i ? sqrt(left) : left / row[i];
        }
    }
}

void tied_reset(struct tied *tied, const struct design *design, const double *tip)
{
    size_t P = (size_t)design->size[2];
    double covariance[DESIGN_DROOP * DESIGN_DROOP];

    whitener_set_diagonal(design->size[2], tied->G, 1.0);
    if (tip) {
        design_droop_prior(design, tip, covariance);
        whiten_droop(covariance, tied->G);
    }
    memset(tied->b, 0, (1 + DESIGN_SIZES) * P * sizeof *tied->b);
    memset(tied->evidence, 0, sizeof tied->evidence);
    tied->turn = 0.0;
    tied->chosen = 0;
}

/* y = G times the first n numbers of each row. */
static void whiten_rows(const struct tied *tied, const struct design *design, int n,
                        const struct kernels *kernels, const double *rows,
                        struct tied_scratch *scratch)
{
    scratch->tested = NULL;
    kernels->whiten_three(n, (size_t)design->size[2], tied->G, rows, scratch->y);
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
    int P = design->size[2];

    whiten_rows(tied, design, P, kernels, rows, scratch);
    scratch->tested = tied;
    for (int k = 0; k < DESIGN_SIZES; k++) {
        double S[9] = {0};
        double with_doubt[9];
        double e[3];
        for (int r = 0; r < 3; r++) {
            e[r] = y[r] - kernels->dot(design->size[k], rows + (ptrdiff_t)r * P, tied->theta[k]);
            for (int s = 0; s <= r; s++)
                S[3 * r + s] = kernels->dot(design->size[k], scratch->y + (ptrdiff_t)r * P,
                                            scratch->y + (ptrdiff_t)s * P) +
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

double tied_fresh_log_density(const struct design *design, const double *rows, const double *y,
                              const double *doubt)
{
    double S[9];

    for (int r = 0; r < 3; r++)
        for (int s = 0; s < 3; s++)
            S[3 * r + s] = doubt[3 * r + s] + (r == s ? 1.0 : 0.0) +
                           vec3_dot(rows + (ptrdiff_t)r * design->size[2],
                                    rows + (ptrdiff_t)s * design->size[2]);
    factor(S);
    return log_density(S, distance_by(S, y));
}

void tied_refresh(struct tied *tied, const struct design *design, const struct kernels *kernels,
                  struct tied_scratch *scratch)
{
    for (int k = 0; k < DESIGN_SIZES; k++)
        kernels->solve(design->size[k], tied->G, tied->b, scratch->back, tied->theta[k]);
}

/* b = C theta = G^-1 G'^-1 theta. */
void tied_set(struct tied *tied, const struct design *design, const struct kernels *kernels,
              const double *theta, struct tied_scratch *scratch)
{
    int P = design->size[2];
    double *half = tied->b;

    memcpy(half, theta, (size_t)P * sizeof *half);
    for (int i = P - 1; i >= 0; i--) { /* G' half = theta */
        const double *row = tied->G + whitener_row(i);
        half[i] /= row[i];
        for (int k = 0; k < i; k++)
            half[k] -= row[k] * half[i];
    }
    for (int i = 0; i < P; i++) { /* G b = half */
        const double *row = tied->G + whitener_row(i);
        double sum = half[i];
        for (int k = 0; k < i; k++)
            sum -= row[k] * tied->b[k];
        tied->b[i] = sum / row[i];
    }
    tied_refresh(tied, design, kernels, scratch);
}

/* Turn t, as whitener_add() makes it (imle/whitener.c has the formula): C becomes delta C + weight
 * v v' with y = G v. */
static void prepare_turn(int P, int t, double delta, double weight, const double *y,
                         struct tied_scratch *scratch)
{
    double *keep = scratch->keep + (size_t)t * scratch->stride;
    double *take = scratch->take + (size_t)t * scratch->stride;
    double *grow = scratch->grow + (size_t)t * scratch->stride;
    double *tau = scratch->sum + (size_t)t * scratch->stride; /* not yet in use */
    double root = sqrt(weight / delta);
    double per_root = 1.0 / sqrt(delta);
    double sum = 1.0;
    double before = 1.0;

    for (int i = 0; i < P; i++) {
        grow[i] = root * y[i];
        sum += grow[i] * grow[i];
        tau[i] = sum;
    }
    for (int i = 0; i < P; i++) {
        tau[i] = sqrt(tau[i]);
        take[i] = 1.0 / tau[i];
    }
    for (int i = 0; i < P; i++) {
        double per_tau = take[i];
        keep[i] = (i > 0 ? tau[i - 1] : 1.0) * per_tau * per_root;
        take[i] = grow[i] * before * per_tau * per_root;
        before = per_tau;
    }
}

/* What turn t makes of y = G v for the old G: G v for the new one. */
static void turn_vector(int P, int t, const struct tied_scratch *scratch, double *y)
{
    const double *keep = scratch->keep + (size_t)t * scratch->stride;
    const double *take = scratch->take + (size_t)t * scratch->stride;
    const double *grow = scratch->grow + (size_t)t * scratch->stride;
    double sum = 0.0;

    for (int i = 0; i < P; i++) {
        double old = y[i];
        y[i] = keep[i] * old - take[i] * sum;
        sum += grow[i] * old;
    }
}

/* G times the unit vector of the coefficient whose turn it is. */
static void column_in_turn(const struct tied *tied, int P, double *y)
{
    int i = (int)tied->turn;

    memset(y, 0, (size_t)P * sizeof *y);
    for (int row = i; row < P; row++)
        y[row] = tied->G[whitener_row(row) + (size_t)i];
}

/* The three rows in one pass over G: y of those that follow is known without G. When the past
 * fades, a coefficient in turn gets back what that took of its prior, in the same pass. */
static void add_rows(struct tied *tied, const struct design *design, const struct kernels *kernels,
                     double h, double keep, struct tied_scratch *scratch)
{
    int P = design->size[2];
    int turns = keep < 1.0 ? TURNS : TURNS - 1;

    if (turns == TURNS)
        column_in_turn(tied, P, scratch->back);
    for (int t = 0; t < turns; t++) {
        double *y = scratch->y + (ptrdiff_t)t * P;
        bool of_prior = t == TURNS - 1;
        prepare_turn(P, t, t == 0 ? keep : 1.0, of_prior ? P * (1.0 - keep) : h, y, scratch);
        for (int later = t + 1; later < turns; later++)
            turn_vector(P, t, scratch, scratch->y + (ptrdiff_t)later * P);
    }
    memset(scratch->sum, 0, TURNS * scratch->stride * sizeof *scratch->sum);
    kernels->rotate_often(P, turns, scratch->stride, tied->G, scratch->keep, scratch->take,
                          scratch->grow, scratch->sum);
    if (turns == TURNS)
        tied->turn = tied->turn + 1.0 < P ? tied->turn + 1.0 : 0.0;
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
        tied->evidence[k] = evidence_kept * tied->evidence[k] + h * fit->log_evidence[k];
    for (int i = 0; i < P && keep < 1.0; i++)
        tied->b[i] *= keep;
    if (scratch->tested != tied)
        whiten_rows(tied, design, P, kernels, rows, scratch);
    scratch->tested = NULL; /* y is used up */
    add_rows(tied, design, kernels, h, keep, scratch);
    for (int row = 0; row < 3; row++)
        kernels->add(P, h * y[row], rows + (ptrdiff_t)row * P, tied->b);
    tied_refresh(tied, design, kernels, scratch);
    choose(tied);
}

void tied_add_doubt(const struct tied *tied, const struct design *design,
                    const struct kernels *kernels, const double *rows, struct tied_scratch *scratch,
                    double *covariance)
{
    int n = design->size[tied->chosen];
    int P = design->size[2];

    whiten_rows(tied, design, n, kernels, rows, scratch);
    for (int r = 0; r < 3; r++)
        for (int s = 0; s < 3; s++)
            covariance[3 * r + s] +=
                kernels->dot(n, scratch->y + (ptrdiff_t)r * P, scratch->y + (ptrdiff_t)s * P);
}
