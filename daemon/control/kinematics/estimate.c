#include "daemon/control/kinematics/estimate.h"

#include <math.h>
#include <string.h>

void select_init(struct selection *selection, int n_inputs, int n_outputs, const double *scale)
{
    memset(selection, 0, sizeof *selection);
    selection->n_inputs = n_inputs;
    selection->n_outputs = n_outputs;
    selection->solution = -1;
    memcpy(selection->scale, scale, sizeof(double) * (size_t)n_outputs);
}

const double *select_jacobian(const struct selection *selection)
{
    if (selection->solution < 0)
        return NULL;
    return selection->prediction.solution[selection->solution].jacobian;
}

const double *select_value(const struct selection *selection)
{
    if (selection->solution < 0)
        return NULL;
    return selection->prediction.solution[selection->solution].value;
}

void select_integrate(struct selection *selection, const double *q)
{
    const double *jacobian = select_jacobian(selection);
    int d = selection->n_inputs;

    for (int row = 0; jacobian && selection->moved_from && row < selection->n_outputs; row++)
        for (int i = 0; i < d; i++)
            selection->x_estimated[row] += jacobian[row * d + i] * (q[i] - selection->q_last[i]);
    memcpy(selection->q_last, q, sizeof(double) * (size_t)d);
    selection->moved_from = true;
}

void select_anchor(struct selection *selection, const double *x)
{
    memcpy(selection->x_estimated, x, sizeof(double) * (size_t)selection->n_outputs);
    selection->anchored = true;
}

int select_closest(const struct selection *selection, const struct learner_prediction *prediction,
                   const double *x)
{
    double least = INFINITY;
    int closest = -1;

    for (int k = 0; k < prediction->n_solutions; k++) {
        double distance = 0;
        for (int row = 0; row < selection->n_outputs; row++) {
            double e = (prediction->solution[k].value[row] - x[row]) / selection->scale[row];
            distance += e * e;
        }
        if (distance < least) {
            least = distance;
            closest = k;
        }
    }
    return closest;
}

void select_solution(struct selection *selection, struct learner *learner, const double *q)
{
    learner_predict(learner, q, &selection->prediction);
    if (selection->anchored)
        selection->solution =
            select_closest(selection, &selection->prediction, selection->x_estimated);
    else
        selection->solution = selection->prediction.n_solutions > 0 ? 0 : -1;
}
