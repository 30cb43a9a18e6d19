/* What the receptive fields say together: the mean of their answers, weighted by activation, its
 * exact derivative, and its confidence (section 3.3 of the paper). */
#include <math.h>
#include <string.h>

#include "learner/lwpr/lwpr.h"

/* Sums over the fields of one output. Weights are relative to that of the nearest field, and
 * answers to the first one taken in, so that neither a far query nor an offset costs digits. */
struct blend {
    double W;                      /* sum w */
    double y0;                     /* the first answer */
    double wy, wyy;                /* sums w (y - y0), w (y - y0)^2 */
    double wv;                     /* sum w variance */
    double dW[LEARNER_MAX_INPUTS]; /* derivatives of W and wy by u */
    double dwy[LEARNER_MAX_INPUTS];
    int members;
    int nearest;
};

static void blend_in_field(const struct lwpr *m, int j, struct blend *blend)
{
    const struct lwpr_field f = lwpr_field_at(m, j);
    const struct lwpr_rank *rank = &m->rank[(int)f.head->output];
    double w = lwpr_weight(m->q[j] - m->q[rank->first]);
    double v[LEARNER_MAX_INPUTS];
    double slope[LEARNER_MAX_INPUTS];
    double Dv[LEARNER_MAX_INPUTS];
    double variance;

    for (int i = 0; i < m->d; i++)
        v[i] = m->u[i] - f.centre[i];
    double y = lwpr_pls_answer(m, &f, v, slope, &variance);
    lwpr_metric_times(m, &f, v, Dv);
    if (blend->members++ == 0) {
        blend->y0 = y;
        blend->nearest = j;
    }
    if (m->q[j] < m->q[blend->nearest])
        blend->nearest = j;
    y -= blend->y0;
    blend->W += w;
    blend->wy += w * y;
    blend->wyy += w * y * y;
    blend->wv += w * variance;
    for (int i = 0; i < m->d; i++) {
        blend->dW[i] -= w * Dv[i];
        blend->dwy[i] += w * (slope[i] - y * Dv[i]);
    }
}

/* In units of norm_out squared: fields that never erred, as on still data, are not certain. */
static const double least_variance = 1e-24;

/* The answers' own variance and their disagreement, both over the sum of activations: few and far
 * fields are not to be trusted. */
static double variance_of(const struct lwpr *m, int output, const struct blend *blend)
{
    double mean = blend->wy / blend->W;
    double disagreement = fmax(blend->wyy / blend->W - mean * mean, 0.0);
    double activation = blend->W * lwpr_weight(m->q[m->rank[output].first]);

    if (!(activation > 0.0) || !isfinite(blend->wv))
        return INFINITY;
    return fmax((disagreement + blend->wv / blend->W) / activation, least_variance);
}

static void fill_in_output(const struct lwpr *m, int output, const struct blend *blend,
                           struct learner_solution *solution)
{
    double norm = m->p.norm_out[output];
    double mean = blend->wy / blend->W;
    double weight = lwpr_weight(m->q[blend->nearest]);

    solution->value[output] = norm * (blend->y0 + mean);
    solution->variance[output] = norm * norm * variance_of(m, output, blend);
    for (int i = 0; i < m->d; i++)
        solution->jacobian[output * m->d + i] =
            norm / m->config.scale[i] * (blend->dwy[i] - mean * blend->dW[i]) / blend->W;
    solution->members += blend->members;
    solution->weight = fmin(solution->weight, weight);
    if (solution->principal < 0 || m->q[blend->nearest] < m->q[solution->principal])
        solution->principal = blend->nearest;
}

int lwpr_predict(struct lwpr *m, const double *z, struct learner_solution *solution)
{
    struct blend blend[LEARNER_MAX_OUTPUTS] = {0};

    lwpr_activate(m, z);
    for (int j = 0; j < m->M; j++) {
        if (!(m->q[j] < m->q_cutoff))
            continue;
        const struct lwpr_field f = lwpr_field_at(m, j);
        if (lwpr_pls_mature(m, &f) > 0)
            blend_in_field(m, j, &blend[(int)f.head->output]);
    }
    for (int o = 0; o < m->D; o++) {
        if (m->rank[o].first < 0)
            return 0;
        if (blend[o].members == 0)
            blend_in_field(m, m->rank[o].first, &blend[o]);
    }
    solution->members = 0;
    solution->principal = -1;
    solution->weight = 1.0;
    for (int o = 0; o < m->D; o++)
        fill_in_output(m, o, &blend[o], solution);
    return 1;
}
