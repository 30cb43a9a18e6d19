/* Joints that bring a tip to a place: for each context, from the kept posture whose output is
 * nearest, by damped least squares on the prediction. */
#include <math.h>
#include <string.h>

#include "learner/body/body_learner.h"
#include "learner/body/chain/order.h"
#include "learner/body/chain/vec3.h"

static const double damping = 1e-3; /* of the squared output that a joint's range makes */
static const double longest = 0.3;  /* step, of a joint's range */
static const double enough = 0.01;  /* of the noise */

/* gain = R J' (J R J' + damping)^-1, d x 3, with outputs in units of noise and R the joints'
 * squared ranges. */
static void gain_of(const struct body *body, const double *jacobian, double *gain)
{
    int d = body->chain.n;
    double S[9] = {0};
    double inverse[9];

    for (int r = 0; r < 3; r++)
        for (int s = 0; s < 3; s++)
            for (int i = 0; i < d; i++)
                S[3 * r + s] += jacobian[r * d + i] * jacobian[s * d + i] * body->range[i] *
                                body->range[i] / (body->noise[r] * body->noise[s]);
    double trace = S[0] + S[4] + S[8];
    for (int r = 0; r < 3; r++)
        S[4 * r] += damping * trace;
    mat3_invert(S, inverse);
    for (int i = 0; i < d; i++)
        for (int s = 0; s < 3; s++) {
            double sum = 0.0;
            for (int r = 0; r < 3; r++)
                sum += jacobian[r * d + i] / body->noise[r] * inverse[3 * r + s];
            gain[3 * i + s] = body->range[i] * body->range[i] * sum;
        }
}

/* One step of z towards x; how far it was, in units of noise, or INFINITY without an answer. */
static double approach(struct body_learner *learner, int j, const double *x, double *z,
                       struct learner_solution *solution)
{
    const struct body *body = &learner->body;
    struct chain_pose pose;
    double gain[3 * CHAIN_MAX_JOINTS];
    double left[3];

    chain_at(&body->chain, z, &pose);
    design_rows(&learner->contexts->design, body, &pose, learner->contexts->rows);
    if (!contexts_answer(learner->contexts, j, z, &pose, solution))
        return INFINITY;
    for (int r = 0; r < 3; r++)
        left[r] = (x[r] - solution->value[r]) / body->noise[r];
    gain_of(body, solution->jacobian, gain);
    for (int i = 0; i < body->chain.n; i++) {
        double most = longest * body->range[i];
        z[i] += fmin(fmax(vec3_dot(gain + (ptrdiff_t)3 * i, left), -most), most);
    }
    return vec3_length(left);
}

/* What is free of the joints once the output is given: the diagonal of R - gain J R. */
static void leave_variance(const struct body *body, const double *jacobian, double *variance)
{
    int d = body->chain.n;
    double gain[3 * CHAIN_MAX_JOINTS];

    gain_of(body, jacobian, gain);
    for (int i = 0; i < d; i++) {
        double taken = 0.0;
        for (int r = 0; r < 3; r++)
            taken += gain[3 * i + r] * jacobian[r * d + i] / body->noise[r];
        variance[i] = body->range[i] * body->range[i] * fmax(1.0 - taken, 0.0);
    }
}

/* The joints with which context j's tip is at x. false when none were found. */
static bool reach_with(struct body_learner *learner, int j, const double *x,
                       struct learner_inverse_solution *out)
{
    enum { MOST_STEPS = 20 };
    const struct context *context = &learner->contexts->context[j];
    int begin = kept_nearest_output(&context->kept, x, learner->body.noise);
    double distance = INFINITY;
    struct learner_solution solution;

    if (begin < 0)
        return false;
    memcpy(out->z, context->kept.z + (ptrdiff_t)begin * context->kept.n_inputs,
           (size_t)context->kept.n_inputs * sizeof(double));
    for (int step = 0; step < MOST_STEPS; step++) {
        distance = approach(learner, j, x, out->z, &solution);
        if (!(distance > enough && distance < INFINITY))
            break;
    }
    if (!(distance < INFINITY))
        return false;
    leave_variance(&learner->body, solution.jacobian, out->variance);
    out->weight = context->recent;
    out->principal = (int)context->number;
    return true;
}

int body_predict_inverse(void *self, const double *x, struct learner_inverse *inverse)
{
    struct body_learner *learner = self;
    struct learner_inverse_solution one = {0};

    if (!learner->found)
        return imle_predict_inverse(learner->meanwhile, x, inverse);
    for (int j = 0; j < learner->contexts->n; j++) {
        if (!reach_with(learner, j, x, &one))
            continue;
        int at = inverse->n_solutions;
        if (at < LEARNER_MAX_SOLUTIONS)
            inverse->n_solutions++;
        else if (inverse->solution[--at].weight >= one.weight)
            continue;
        order_to_inputs(&learner->config, 1, one.z);
        order_to_inputs(&learner->config, 1, one.variance);
        for (; at > 0 && inverse->solution[at - 1].weight < one.weight; at--)
            inverse->solution[at] = inverse->solution[at - 1];
        inverse->solution[at] = one;
    }
    return inverse->n_solutions;
}
