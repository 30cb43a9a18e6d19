/* Receptive fields: how near a query is to each, new ones, and the removal of one. */
#include <math.h>
#include <string.h>

#include "learner/lwpr/lwpr.h"

static void rank_field(const struct lwpr *m, struct lwpr_rank *rank, int j)
{
    if (rank->first < 0 || m->q[j] < m->q[rank->first]) {
        rank->second = rank->first;
        rank->first = j;
    } else if (rank->second < 0 || m->q[j] < m->q[rank->second]) {
        rank->second = j;
    }
}

void lwpr_activate(struct lwpr *m, const double *z)
{
    double v[LEARNER_MAX_INPUTS];

    for (int i = 0; i < m->d; i++)
        m->u[i] = z[i] / m->config.scale[i];
    for (int o = 0; o < m->D; o++)
        m->rank[o] = (struct lwpr_rank){-1, -1};
    struct lwpr_field f = lwpr_field_at(m, 0);
    for (int j = 0; j < m->M; j++) {
        for (int i = 0; i < m->d; i++)
            v[i] = m->u[i] - f.centre[i];
        m->q[j] = lwpr_distance(m, &f, v);
        rank_field(m, &m->rank[(int)f.head->output], j);
        f.centre += m->d;
        f.root += m->n_root;
        f.head++;
    }
}

static void initial_metric(const struct lwpr *m, const struct lwpr_field *f)
{
    for (int i = 0; i < m->n_root; i++) {
        f->root[i] = 0.0;
        f->rate[i] = m->p.init_alpha;
    }
    for (int row = 0, i = 0; row < m->d; row++) {
        f->root[i] = sqrt(m->p.init_d);
        i = lwpr_next_diagonal(m, i, row);
    }
}

int lwpr_field_birth(struct lwpr *m, int output)
{
    int j = m->M++;
    struct lwpr_field f = lwpr_field_at(m, j);

    memcpy(f.centre, m->u, (size_t)m->d * sizeof(double));
    memset(f.mean, 0, (size_t)m->d * sizeof(double));
    *f.head = (struct lwpr_head){.output = output, .n_projections = m->R > 1 ? 2 : 1};
    for (int r = 0; r < m->R; r++)
        lwpr_pls_start(m, &f, r);
    initial_metric(m, &f);
    return j;
}

void lwpr_field_remove(struct lwpr *m, int j)
{
    int last = --m->M;

    if (j == last)
        return;
    for (int k = 0; k < LWPR_PARTS; k++) {
        unsigned char *part = m->part[k];
        memcpy(part + (size_t)j * m->width[k], part + (size_t)last * m->width[k], m->width[k]);
    }
}
