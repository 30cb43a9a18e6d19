/* How well a learner predicts a table of samples. Distances between outputs are Euclidean, in the
 * units of the table. */
#ifndef REACH_EVAL_SCORE_H
#define REACH_EVAL_SCORE_H

#include <stddef.h>

#include "learner/learner.h"
#include "tools/eval/csv.h"
#include "tools/measure/durations.h"

/* Root of the mean squared error of each output, and the mean of these. NaN without any answer. */
struct score_rmse {
    size_t n; /* answers that it is of */
    double component[LEARNER_MAX_OUTPUTS];
    double mean;
};

/* |J - J_true| / |J_true|, Frobenius norms, of the closest solution; rows with J_true = 0 are left
 * out. NaN without any. */
struct score_jacobian {
    size_t n;
    double median, mean;
};

/* Independent queries. */
struct score_test {
    size_t n_rows;
    size_t n_unanswered;                      /* no solution at all; they are in no error below */
    struct score_rmse closest;                /* the solution nearest to the truth */
    struct score_rmse strongest;              /* the solution of largest weight */
    struct score_rmse single;                 /* the single-valued prediction */
    double mean_solutions;                    /* over all rows */
    size_t n_with[LEARNER_MAX_SOLUTIONS + 1]; /* rows with that many solutions */
    struct score_jacobian jacobian;
};

/* A smooth trajectory, row after row: the solution that is followed is the one nearest to the true
 * output of the row before. The first row only starts it. */
struct score_track {
    size_t n_rows; /* without the first */
    size_t n_unanswered;
    struct score_rmse followed;
    struct score_rmse closest;
    size_t n_wrong;      /* followed another solution than the closest */
    double wrong_branch; /* their share of the rows */
    double mean_solutions;
    struct score_jacobian jacobian; /* of the followed solution */
};

/* Both add the time of each multi-valued prediction, Jacobian included, to `durations`. */
struct score_test score_test(struct learner *learner, const struct csv_table *table,
                             struct durations *durations);
struct score_track score_track(struct learner *learner, const struct csv_table *table,
                               struct durations *durations);

#endif
