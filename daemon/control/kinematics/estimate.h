/* Where the end-effector is by the model, and which of its solutions that is: the context, followed
 * over time.
 *
 * Between fixations the output is not measured but estimated from the joints' motion (eq. 14), and
 * the solution closest to that is taken (paper section 4). "Closest" is in scaled task rows, since
 * they differ in unit. Used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_KINEMATICS_ESTIMATE_H
#define REACH_DAEMON_CONTROL_KINEMATICS_ESTIMATE_H

#include "daemon/config/sizes.h"
#include "learner/learner.h"

#include <stdbool.h>

struct estimate {
    int n_inputs;
    int n_outputs;
    double scale[MAX_OUTPUTS];            /* what counts as one in each output */
    struct learner_prediction prediction; /* at the joints of the last estimate_choose */
    int solution;                         /* index of the one in use, -1 = none */
    bool anchored;                        /* an output was ever measured */
    bool moved_from;                      /* q_last holds */
    double q_last[MAX_JOINTS];            /* rad */
    double x_estimated[MAX_OUTPUTS];      /* eq. 14 */
};

void estimate_init(struct estimate *estimate, int n_inputs, int n_outputs, const double *scale);

/* Equation 14: x_estimated += J(previous step) (q - q_last). Then q becomes q_last. */
void estimate_integrate(struct estimate *estimate, const double *q);

/* An output was measured: the estimate starts from it. */
void estimate_anchor(struct estimate *estimate, const double *x);

/* Predicts at q and chooses the solution closest to x_estimated; before any output was measured,
 * the strongest. */
void estimate_choose(struct estimate *estimate, struct learner *learner, const double *q);

/* Index of the solution of `prediction` that is closest to x, -1 when there is none. */
int estimate_closest(const struct estimate *estimate, const struct learner_prediction *prediction,
                     const double *x);

/* Jacobian of the solution in use (n_outputs x n_inputs, row-major), NULL when there is none. */
const double *estimate_jacobian(const struct estimate *estimate);

/* Value of the solution in use, NULL when there is none. */
const double *estimate_value(const struct estimate *estimate);

#endif
