/* How much of a tool's motion is no rigid chain: what its samples are off by from a tip that keeps
 * its place in the last frame. */
#include <math.h>

#include "learner/body/body_learner.h"
#include "learner/body/search/search.h"

static struct context *most_in_use(struct contexts *contexts)
{
    struct context *most = NULL;

    for (int j = 0; j < contexts->n; j++)
        if (!most || contexts->context[j].recent > most->recent)
            most = &contexts->context[j];
    return most;
}

/* Squares of the outputs, each in its own unit; those that the eyes cannot see are left out.
 * Returns how many samples there were. */
static int add_squares(struct contexts *contexts, const struct context *context, double *squares)
{
    const struct kept *kept = &context->kept;
    const double *tip = context->tied.theta[0];
    ptrdiff_t P = contexts->design.size[2];
    double y[BODY_OUTPUTS];
    int count = 0;

    for (int i = 0; i < kept->n; i++) {
        if (!contexts_whiten(contexts, kept->z + (ptrdiff_t)i * kept->n_inputs,
                             kept->x + (ptrdiff_t)i * BODY_OUTPUTS, y))
            continue;
        for (int r = 0; r < BODY_OUTPUTS; r++) {
            double left = y[r] - contexts->kernels->dot(DESIGN_TIP, contexts->white + r * P, tip);
            squares[r] += left * left * contexts->body->noise[r] * contexts->body->noise[r];
        }
        count++;
    }
    return count;
}

int body_not_rigid(void *self, double *share)
{
    struct body_learner *learner = self;
    struct finder_settings told = finder_settings_of(&learner->config);
    double squares[BODY_OUTPUTS] = {0};
    const struct context *context = learner->found ? most_in_use(learner->contexts) : NULL;
    int count = context ? add_squares(learner->contexts, context, squares) : 0;

    if (count == 0)
        return -1;
    for (int r = 0; r < BODY_OUTPUTS; r++) {
        /* A noise told too high is no reason to call what is left none. */
        double noise = fmin(told.noise[r], learner->body.noise[r]);
        share[r] = sqrt(fmax(squares[r] / count - noise * noise, 0.0));
    }
    return 0;
}
