/* Clusters by splitting: as long as the members of one disagree more than chance allows, it is
 * split in two (paper section 3; the published rule, and its variant with other variances).
 *
 * Bounded: at most n_solutions_max - 1 splits of em_pred_iterations steps over IMLE_MOST_ANSWERS
 * answers. Answers lie side by side, output by output, for the vector kernels; what is missing to a
 * multiple of eight has no weight. */
#include <math.h>
#include <string.h>

#include "daemon/imle_chi2.h"
#include "daemon/imle_private.h"

/* Under this level of significance the mean of chi-square says nothing: its level is at most .683.
 */
static const double level_of_mean = 0.69;

struct imle_split_scratch {
    int n;      /* clusters */
    int padded; /* answers, up to a multiple of eight */
    double center[LEARNER_MAX_SOLUTIONS][LEARNER_MAX_OUTPUTS];
    double x[LEARNER_MAX_OUTPUTS][IMLE_MOST_ANSWERS];
    double weight[LEARNER_MAX_OUTPUTS][IMLE_MOST_ANSWERS]; /* R_j^-1 */
    double p[LEARNER_MAX_SOLUTIONS][IMLE_MOST_ANSWERS];    /* deviations, then probabilities */
    double nearest[IMLE_MOST_ANSWERS];                     /* smallest deviation of each answer */
    double sum[IMLE_MOST_ANSWERS];
    double T[LEARNER_MAX_SOLUTIONS]; /* sum of deviations of the members */
    double t[LEARNER_MAX_SOLUTIONS]; /* sum of t, and of its square */
    double tt[LEARNER_MAX_SOLUTIONS];
    int members[LEARNER_MAX_SOLUTIONS];
};

_Static_assert(IMLE_MOST_ANSWERS % KERNEL_LANES == 0, "rows of answers are padded to whole lanes");

size_t imle_split_memory(void)
{
    return sizeof(struct imle_split_scratch);
}

static void lay_out_answers(struct imle *m)
{
    struct imle_split_scratch *s = m->split;

    s->padded = (m->n_answers + KERNEL_LANES - 1) / KERNEL_LANES * KERNEL_LANES;
    for (int i = 0; i < m->D; i++)
        for (int a = 0; a < s->padded; a++) {
            const struct imle_answer *answer = &m->answers[a];
            bool real = a < m->n_answers;
            s->x[i][a] = real ? answer->xhat[i] : 0.0;
            s->weight[i][a] =
                real ? 1.0 / (answer->spread * m->psi[answer->expert * m->D + i]) : 0.0;
        }
}

/* (xhat_j - center)' R_j^-1 (xhat_j - center) of all answers. */
static void deviations(const struct imle *m, const double *center, double *deviation)
{
    struct imle_split_scratch *s = m->split;

    m->kernels->deviations(s->padded, m->D, IMLE_MOST_ANSWERS, s->x[0], s->weight[0], center,
                           deviation);
}

/* Deviations from every center, and the nearest of each answer. */
static void all_deviations(struct imle *m)
{
    struct imle_split_scratch *s = m->split;

    for (int k = 0; k < s->n; k++)
        deviations(m, s->center[k], s->p[k]);
    memcpy(s->nearest, s->p[0], (size_t)s->padded * sizeof(double));
    for (int k = 1; k < s->n; k++)
        for (int a = 0; a < s->padded; a++)
            s->nearest[a] = s->p[k][a] < s->nearest[a] ? s->p[k][a] : s->nearest[a];
}

/* Mean of all answers, each weighted by R_j^-1 and its probability of belonging to cluster k.
 * Returns whether the center moved. */
static bool move_center(struct imle *m, int k)
{
    struct imle_split_scratch *s = m->split;
    bool moved = false;

    for (int i = 0; i < m->D; i++) {
        double top = 0.0;
        double bottom = 0.0;
        m->kernels->weighted_sums(s->padded, s->p[k], s->weight[i], s->x[i], &top, &bottom);
        if (!(bottom > 0.0))
            continue;
        moved = moved || s->center[k][i] != top / bottom;
        s->center[k][i] = top / bottom;
    }
    return moved;
}

/* EM_pred: one iteration. p_jk is proportional to exp(-deviation / 2), over all clusters; the
 * deviations come from the centers before any has moved. Returns whether any has. */
static bool em_iteration(struct imle *m)
{
    struct imle_split_scratch *s = m->split;
    bool moved = false;

    all_deviations(m);
    memset(s->sum, 0, (size_t)s->padded * sizeof(double));
    for (int k = 0; k < s->n; k++)
        m->kernels->memberships(s->padded, s->p[k], s->nearest, s->sum);
    for (int k = 0; k < s->n; k++) {
        m->kernels->normalise(s->padded, s->p[k], s->sum);
        moved = move_center(m, k) || moved;
    }
    return moved;
}

/* What the test of each cluster needs. */
static void sum_members(struct imle *m)
{
    struct imle_split_scratch *s = m->split;

    memset(s->T, 0, sizeof s->T);
    memset(s->t, 0, sizeof s->t);
    memset(s->tt, 0, sizeof s->tt);
    memset(s->members, 0, sizeof s->members);
    for (int a = 0; a < m->n_answers; a++) {
        const struct imle_answer *answer = &m->answers[a];
        s->T[answer->cluster] += s->nearest[a];
        s->t[answer->cluster] += answer->t;
        s->tt[answer->cluster] += answer->t * answer->t;
        s->members[answer->cluster]++;
    }
}

/* Each answer goes to its most probable cluster; clusters that nobody chose are dropped. */
static void assign(struct imle *m)
{
    struct imle_split_scratch *s = m->split;
    int renamed[LEARNER_MAX_SOLUTIONS] = {0};
    bool chosen[LEARNER_MAX_SOLUTIONS] = {false};
    int n = 0;

    all_deviations(m);
    for (int a = 0; a < m->n_answers; a++) {
        int k = 0;
        while (s->p[k][a] > s->nearest[a])
            k++;
        m->answers[a].cluster = k;
        chosen[k] = true;
    }
    for (int k = 0; k < s->n; k++) {
        renamed[k] = n;
        if (chosen[k])
            memmove(s->center[n++], s->center[k], sizeof s->center[k]);
    }
    for (int a = 0; a < m->n_answers; a++)
        m->answers[a].cluster = renamed[m->answers[a].cluster];
    s->n = n;
    sum_members(m);
}

/* How sure it is that cluster k is more than one; 0 when the significance is out of reach. */
static double split_level(const struct imle *m, int k)
{
    const struct imle_split_scratch *s = m->split;
    double dof = m->config.clustering == LEARNER_CLUSTER_SPLIT
                     ? (s->members[k] - 1) * m->D
                     : (s->t[k] * s->t[k] / s->tt[k] - 1.0) * m->D + 1.0;

    if (s->members[k] < 2 || (s->T[k] <= dof && m->config.significance > level_of_mean))
        return 0.0;
    return chi2_cdf(dof, s->T[k]);
}

/* The member of cluster k that is farthest from x. */
static int farthest_member(struct imle *m, int k, const double *x)
{
    double *deviation = m->split->sum;
    int farthest = -1;

    deviations(m, x, deviation);
    for (int a = 0; a < m->n_answers; a++)
        if (m->answers[a].cluster == k && (farthest < 0 || deviation[a] > deviation[farthest]))
            farthest = a;
    return farthest;
}

static void split(struct imle *m, int k)
{
    struct imle_split_scratch *s = m->split;
    int first = farthest_member(m, k, s->center[k]);
    int second = farthest_member(m, k, m->answers[first].xhat);
    bool moved = true;

    memcpy(s->center[k], m->answers[first].xhat, sizeof s->center[k]);
    memcpy(s->center[s->n++], m->answers[second].xhat, sizeof s->center[k]);
    for (int i = 0; i < m->config.em_pred_iterations && moved; i++)
        moved = em_iteration(m);
    assign(m);
}

/* The cluster with the largest level above the significance, or -1. */
static int cluster_to_split(const struct imle *m)
{
    double largest = m->config.significance;
    int worst = -1;

    for (int k = 0; k < m->split->n; k++) {
        double level = split_level(m, k);
        if (level > largest) {
            largest = level;
            worst = k;
        }
    }
    return worst;
}

int imle_cluster_by_splitting(struct imle *m)
{
    struct imle_split_scratch *s = m->split;

    s->n = 1;
    lay_out_answers(m);
    for (int a = 0; a < s->padded; a++)
        s->p[0][a] = 1.0;
    memset(s->center[0], 0, sizeof s->center[0]);
    (void)move_center(m, 0);
    all_deviations(m);
    sum_members(m);
    while (s->n < m->config.n_solutions_max) {
        int before = s->n;
        int worst = cluster_to_split(m);
        if (worst >= 0)
            split(m, worst);
        if (s->n <= before)
            break;
    }
    return s->n;
}
