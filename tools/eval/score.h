/* How well a learner predicts a table of samples. Distances between outputs are Euclidean, in the
 * units of the table. */
#ifndef REACH_EVAL_SCORE_H
#define REACH_EVAL_SCORE_H

#include <stddef.h>

#include "learner/health/health.h"
#include "learner/learner.h"
#include "tools/eval/csv.h"
#include "tools/eval/rows.h"
#include "tools/measure/durations.h"

/* Root of the mean squared error of each output, and the mean of these; median and 95 % point of
 * the distance to the truth. NaN without any answer. */
struct score_error {
    size_t n; /* answers that it is of */
    double rmse[LEARNER_MAX_OUTPUTS];
    double mean;
    double median, p95;
};

/* |error| / stated standard deviation of the closest solution, over rows and outputs. Where errors
 * are as stated and Gaussian, the median is 0.67 and the 95 % point 1.96; larger: the learner is
 * too sure. NaN without any; what is stated as infinite is left out. */
struct score_calibration {
    size_t n;
    double median, p95;
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
    struct score_error closest;               /* the solution nearest to the truth */
    struct score_error strongest;             /* the solution of largest weight */
    struct score_error single;                /* the single-valued prediction */
    struct score_calibration calibration;     /* of the closest */
    double mean_solutions;                    /* over all rows */
    size_t n_with[LEARNER_MAX_SOLUTIONS + 1]; /* rows with that many solutions */
    struct score_jacobian jacobian;
};

/* A smooth trajectory, row after row: the solution that is followed is the one nearest to the true
 * output of the row before. The first row only starts it. */
struct score_track {
    size_t n_rows; /* without the first */
    size_t n_unanswered;
    struct score_error followed;
    struct score_error closest;
    struct score_error strongest;
    struct score_calibration calibration; /* of the closest */
    size_t n_wrong;                       /* followed another solution than the closest */
    double wrong_branch;                  /* their share of the rows */
    double mean_solutions;
    struct score_jacobian jacobian; /* of the followed solution */
};

/* What a score takes beside the samples. */
struct score_desk {
    struct learner *learner;
    struct durations *durations; /* takes the time of each multi-valued prediction, with Jacobian */
    struct rows *rows;           /* takes each row's predictions, or NULL */
    struct health *health;       /* counts solutions */
};

/* `name` is for the rows. Both end the program when memory is out. */
struct score_test score_test(const struct score_desk *desk, const char *name,
                             const struct csv_table *table);
struct score_track score_track(const struct score_desk *desk, const char *name,
                               const struct csv_table *table);

#endif
