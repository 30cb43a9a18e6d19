/* A Bayesian regression whose coefficients are shared by the rows of an output:
 *
 *   y = Phi theta + noise,   theta ~ N(0, I),   noise ~ N(0, I)
 *
 * (of the droop, what design_droop_prior() says, in the beginning; what fades is filled up by I).
 *
 * Phi has 3 rows (whoever calls has divided rows and y by the noise). It is carried as the whitener
 * G of the information matrix C = I + sum Phi' Phi and the vector b = sum Phi' y. The leading k
 * coefficients alone make a regression of their own, whose C is the leading block of C and whose
 * whitener is the beginning of G: so the nested sizes of a design share all of it, and differ in
 * theta alone. Their marginal likelihoods, by the chain rule, say which to answer with. */
#ifndef REACH_LEARNER_BODY_TOOL_TIED_H
#define REACH_LEARNER_BODY_TOOL_TIED_H

#include "learner/body/tool/design.h"
#include "learner/imle/whitener.h"

#ifdef __cplusplus
extern "C" {
#endif

struct tied {
    double *G; /* packed lower triangle of the largest size */
    double *b; /* size[2] */
    double *theta[DESIGN_SIZES];
    double evidence[DESIGN_SIZES]; /* log marginal likelihood, newest samples count most */
    double turn;                   /* coefficient whose prior is topped up next */
    int chosen;                    /* the size that answers */
};

/* Scratch of one call, shared by all regressions. */
struct tied_scratch {
    double *y;    /* 3 times size[2]: G times each row */
    double *back; /* size[2]; and one more y: of the coefficient whose prior is topped up */
    double *keep; /* of rotate_often(): four rows each, `stride` apart */
    double *take;
    double *grow;
    double *sum;
    size_t stride;
    const struct tied *tested; /* whose y it is, of rows that tied_test() saw */
};

/* Doubles that a regression keeps, and scratch takes. */
size_t tied_numbers(const struct design *design);
size_t tied_scratch_numbers(const struct design *design);

/* Lays a regression, or the scratch, over that many numbers. */
void tied_place(struct tied *tied, const struct design *design, double *numbers);
void tied_place_scratch(struct tied_scratch *scratch, const struct design *design, double *numbers);

/* Knows nothing, or of what is long where it ends: tip[3] in the last frame, or NULL. */
void tied_reset(struct tied *tied, const struct design *design, const double *tip);

/* What each size makes of rows (3 x size[2], divided by the noise) and their y[3]: the squared
 * distance of y from its prediction in units of what it may differ, and the log density of y; both
 * with `doubt` (3 x 3, of what stands behind the rows) as part of that. Evidence goes without: a
 * doubt errs for all samples alike, and would excuse what a larger size explains. */
struct tied_fit {
    double distance[DESIGN_SIZES];
    double log_density[DESIGN_SIZES];
    double log_evidence[DESIGN_SIZES];
};
void tied_test(const struct tied *tied, const struct design *design, const struct kernels *kernels,
               const double *rows, const double *y, const double *doubt,
               struct tied_scratch *scratch, struct tied_fit *fit);

/* The log density of y for a tip of which nothing is known. */
double tied_fresh_log_density(const struct design *design, const double *rows, const double *y,
                              const double *doubt);

/* Learns them with weight h in 0 .. 1; `keep` in (0, 1] is what the past still counts. `fit` is
 * what tied_test said of them. */
void tied_learn(struct tied *tied, const struct design *design, const struct kernels *kernels,
                const double *rows, const double *y, double h, double keep,
                struct tied_scratch *scratch, const struct tied_fit *fit);

/* covariance[9] += Phi C^-1 Phi' of the chosen size, for rows in any unit. */
void tied_add_doubt(const struct tied *tied, const struct design *design,
                    const struct kernels *kernels, const double *rows, struct tied_scratch *scratch,
                    double *covariance);

/* From now on it answers with theta[size[2]], as sure of it as it was. */
void tied_set(struct tied *tied, const struct design *design, const struct kernels *kernels,
              const double *theta, struct tied_scratch *scratch);

/* theta from G and b: after they were loaded. */
void tied_refresh(struct tied *tied, const struct design *design, const struct kernels *kernels,
                  struct tied_scratch *scratch);

#ifdef __cplusplus
}
#endif
#endif
