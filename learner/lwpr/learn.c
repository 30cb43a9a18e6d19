/* One sample through all receptive fields (table 2 of the paper). */
#include "learner/lwpr/lwpr.h"

static bool is_known(const struct lwpr *m, int output)
{
    int nearest = m->rank[output].first;

    return nearest >= 0 && m->q[nearest] < m->q_gen;
}

static int count_births(const struct lwpr *m)
{
    int births = 0;

    for (int o = 0; o < m->D; o++)
        births += !is_known(m, o);
    return births;
}

static void learn_in_field(const struct lwpr *m, int j, const double *x)
{
    const struct lwpr_field f = lwpr_field_at(m, j);
    int output = (int)f.head->output;
    struct lwpr_step step = {.w = lwpr_weight(m->q[j])};

    for (int i = 0; i < m->d; i++)
        step.v[i] = m->u[i] - f.centre[i];
    lwpr_pls_learn(m, &f, x[output] / m->p.norm_out[output], &step);
    lwpr_metric_learn(m, &f, &step);
}

/* A field for every output that has none nearby. */
static void give_birth_to_fields(struct lwpr *m, const double *x)
{
    for (int o = 0; o < m->D; o++) {
        if (is_known(m, o))
            continue;
        int j = lwpr_field_birth(m, o);
        m->q[j] = 0.0;
        learn_in_field(m, j, x);
    }
}

/* Of two fields that a sample activates nearly fully, the one with the narrower metric goes. */
static int superfluous_field(const struct lwpr *m, const struct lwpr_rank *rank)
{
    double trace[2];

    if (rank->second < 0 || m->q[rank->second] >= m->q_prune)
        return -1;
    for (int k = 0; k < 2; k++) {
        const struct lwpr_field f = lwpr_field_at(m, k == 0 ? rank->first : rank->second);
        trace[k] = 0.0;
        for (int i = 0; i < m->n_root; i++)
            trace[k] += f.root[i] * f.root[i];
    }
    return trace[0] > trace[1] ? rank->first : rank->second;
}

/* Highest index first, since removal gives the last field's index to another. */
static void prune_fields(struct lwpr *m)
{
    int doomed[LEARNER_MAX_OUTPUTS];

    for (int o = 0; o < m->D; o++)
        doomed[o] = superfluous_field(m, &m->rank[o]);
    for (int n = 0; n < m->D; n++) {
        int highest = 0;
        for (int o = 1; o < m->D; o++)
            if (doomed[o] > doomed[highest])
                highest = o;
        if (doomed[highest] < 0)
            return;
        lwpr_field_remove(m, doomed[highest]);
        doomed[highest] = -1;
    }
}

enum learner_update_result lwpr_learn(struct lwpr *m, const double *z, const double *x)
{
    lwpr_activate(m, z);
    int births = count_births(m);
    if (births > m->config.capacity - m->M)
        return LEARNER_FULL;
    int known = m->M;
    for (int j = 0; j < known; j++)
        if (m->q[j] < m->q_cutoff)
            learn_in_field(m, j, x);
    give_birth_to_fields(m, x);
    prune_fields(m);
    return births > 0 ? LEARNER_BORN : LEARNER_UPDATED;
}
