/* What a context predicts. */
#include <math.h>
#include <string.h>

#include "learner/body/chain/vec3.h"
#include "learner/body/contexts/contexts.h"

/* Where the tip is in space. */
static void tip_of(const struct contexts *contexts, int j, const struct chain_pose *pose,
                   double *place)
{
    const struct tied *tied = &contexts->context[j].tied;
    int P = contexts->design.size[2];

    for (int r = 0; r < 3; r++)
        place[r] = pose->p[r] + contexts->kernels->dot(contexts->design.size[tied->chosen],
                                                       contexts->rows + (ptrdiff_t)r * P,
                                                       tied->theta[tied->chosen]);
}

static void slope_of(const struct contexts *contexts, int j, const struct chain_pose *pose,
                     double *slope)
{
    const struct tied *tied = &contexts->context[j].tied;
    double by_design[3 * CHAIN_MAX_JOINTS];
    int n = 3 * contexts->body->chain.n;

    chain_jacobian(&contexts->body->chain, pose, pose->p, slope);
    design_slope(&contexts->design, contexts->body, pose, contexts->design.size[tied->chosen],
                 tied->theta[tied->chosen], by_design);
    for (int i = 0; i < n; i++)
        slope[i] += by_design[i];
}

/* Newton's search for what the eyes say begins at what they said at the nearest posture. */
static bool begin_at_sample(const struct kept *kept, const double *z, double *x)
{
    int nearest = kept_nearest(kept, z);

    if (nearest >= 0)
        memcpy(x, kept->x + (ptrdiff_t)nearest * BODY_OUTPUTS, BODY_OUTPUTS * sizeof *x);
    return nearest >= 0;
}

bool contexts_answer(struct contexts *contexts, int j, const double *z,
                     const struct chain_pose *pose, struct learner_solution *solution)
{
    struct context *context = &contexts->context[j];
    int d = contexts->body->chain.n;
    double slope[3 * CHAIN_MAX_JOINTS];
    double covariance[9] = {0};
    double by_place[9];
    double place[3];
    double half[9];

    tip_of(contexts, j, pose, place);
    if (contexts->body->sees && !begin_at_sample(&context->kept, z, solution->value))
        return false;
    if (!body_output(contexts->body, place, solution->value, by_place))
        return false;
    tied_add_doubt(&context->tied, &contexts->design, contexts->kernels, contexts->rows,
                   &contexts->scratch, covariance);
    for (int i = 0; i < 9; i++)
        covariance[i] *= context->scale;
    body_add_doubt(contexts->body, pose, place, solution->value, covariance);
    mat3_multiply(by_place, covariance, half);
    slope_of(contexts, j, pose, slope);
    for (int r = 0; r < 3; r++) {
        solution->variance[r] = vec3_dot(half + (ptrdiff_t)3 * r, by_place + (ptrdiff_t)3 * r);
        for (int i = 0; i < d; i++)
            solution->jacobian[r * d + i] = by_place[3 * r] * slope[i] +
                                            by_place[3 * r + 1] * slope[d + i] +
                                            by_place[3 * r + 2] * slope[2 * d + i];
    }
    solution->members = 1;
    solution->principal = (int)context->number;
    return true;
}
