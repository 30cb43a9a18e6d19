#include "daemon/control/kinematics/estimate.h"

#include <math.h>
#include <string.h>

void estimate_init(struct estimate *estimate, int n_inputs, int n_outputs, const double *scale)
{
    memset(estimate, 0, sizeof *estimate);
    estimate->n_inputs = n_inputs;
    estimate->n_outputs = n_outputs;
    estimate->solution = -1;
    memcpy(estimate->scale, scale, sizeof(double) * (size_t)n_outputs);
}

const double *estimate_jacobian(const struct estimate *estimate)
{
    if (estimate->solution < 0)
        return NULL;
    return estimate->prediction.solution[estimate->solution].jacobian;
}

const double *estimate_value(const struct estimate *estimate)
{
    if (estimate->solution < 0)
        return NULL;
    return estimate->prediction.solution[estimate->solution].value;
}

void estimate_integrate(struct estimate *estimate, const double *q)
{
    const double *jacobian = estimate_jacobian(estimate);
    int d = estimate->n_inputs;

    for (int row = 0; jacobian && estimate->moved_from && row < estimate->n_outputs; row++)
        for (int i = 0; i < d; i++)
            estimate->x_estimated[row] += jacobian[row * d + i] * (q[i] - estimate->q_last[i]);
    memcpy(estimate->q_last, q, sizeof(double) * (size_t)d);
    estimate->moved_from = true;
}

void estimate_anchor(struct estimate *estimate, const double *x)
{
    memcpy(estimate->x_estimated, x, sizeof(double) * (size_t)estimate->n_outputs);
    estimate->anchored = true;
}

int estimate_closest(const struct estimate *estimate, const struct learner_prediction *prediction,
                     const double *x)
{
    double least = INFINITY;
    int closest = -1;

    for (int k = 0; k < prediction->n_solutions; k++) {
        double distance = 0;
        for (int row = 0; row < estimate->n_outputs; row++) {
            double e = (prediction->solution[k].value[row] - x[row]) / estimate->scale[row];
            distance += e * e;
        }
        if (distance < least) {
            least = distance;
            closest = k;
        }
    }
    return closest;
}

void estimate_choose(struct estimate *estimate, struct learner *learner, const double *q)
{
    learner_predict(learner, q, &estimate->prediction);
    if (estimate->anchored)
        estimate->solution =
            estimate_closest(estimate, &estimate->prediction, estimate->x_estimated);
    else
        estimate->solution = estimate->prediction.n_solutions > 0 ? 0 : -1;
}
