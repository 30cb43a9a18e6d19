/* Clusters by splitting: as long as the members of one disagree more than chance allows, it is
 * split in two (paper section 3; the published rule, and its variant with other variances).
 *
 * Bounded: at most n_solutions_max - 1 splits of em_pred_iterations steps over IMLE_MOST_ANSWERS
 * answers. Answers lie side by side, output by output, for the vector kernels; what is missing to a
 * multiple of eight has no weight. */
#include <math.h>
#include <string.h>

#include "learner/imle/chi2.h"
#include "learner/imle/imle.h"

/* Under this level of significance the mean of chi-square says nothing: its level is at most .683.
 */
static const double level_of_mean = 0.69;

/* Answers with t below exp(-this) of the largest do not move centers; they are assigned and tested
 * like the others. A center is off by less than M exp(-this) of what they differ from it. */
static const double light = 19.0;

/* EM_pred is at rest when no center moves by more than the root of this, in its own standard
 * deviations. */
static const double at_rest = 1e-12;

/* Pairs of an answer and a cluster that the EM steps of one prediction may look at; when they run
 * out each further split has to do with two steps. */
enum { MOST_PAIRS = 20000, LEAST_STEPS = 2 };

struct imle_split_scratch {
    int n;      /* clusters */
    int padded; /* answers, up to a multiple of eight */
    int heavy;  /* those that move centers come first; also up to a multiple of eight */
    int pairs;  /* looked at in EM steps so far */
    int index[IMLE_MOST_ANSWERS]; /* of the answer in m->query.answers */
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

static int whole_lanes(int n)
{
    return (n + KERNEL_LANES - 1) / KERNEL_LANES * KERNEL_LANES;
}

/* The heavy answers first, both in their order. */
static void order_by_weight(struct imle *m)
{
    struct imle_split_scratch *s = m->query.split;
    double least = m->query.largest_log_t - light;
    int n = 0;

    for (int a = 0; a < m->query.n_answers; a++)
        if (m->query.answers[a].log_t >= least)
            s->index[n++] = a;
    s->heavy = whole_lanes(n);
    for (int a = 0; a < m->query.n_answers; a++)
        if (m->query.answers[a].log_t < least)
            s->index[n++] = a;
    s->padded = whole_lanes(n);
}

static void lay_out_answers(struct imle *m)
{
    struct imle_split_scratch *s = m->query.split;

    order_by_weight(m);
    for (int a = 0; a < m->query.n_answers; a++) {
        const struct imle_answer *answer = &m->query.answers[s->index[a]];
        const double *psi = m->state.psi + (size_t)answer->expert * (size_t)m->D;
        for (int i = 0; i < m->D; i++) {
            s->x[i][a] = answer->xhat[i];
            s->weight[i][a] = 1.0 / (answer->spread * psi[i]);
        }
    }
    for (int a = m->query.n_answers; a < s->padded; a++)
        for (int i = 0; i < m->D; i++)
            s->x[i][a] = s->weight[i][a] = 0.0;
}

/* (xhat_j - center)' R_j^-1 (xhat_j - center) of the first n answers; s->nearest falls to it. */
static void deviations(const struct imle *m, int n, const double *center, double *deviation)
{
    struct imle_split_scratch *s = m->query.split;

    m->kernels->deviations(n, m->D, IMLE_MOST_ANSWERS, s->x[0], s->weight[0], center, deviation,
                           s->nearest);
}

/* Deviations of the first n answers from every center, and the nearest of each answer. */
static void all_deviations(struct imle *m, int n)
{
    struct imle_split_scratch *s = m->query.split;

    for (int a = 0; a < n; a++)
        s->nearest[a] = INFINITY;
    for (int k = 0; k < s->n; k++)
        deviations(m, n, s->center[k], s->p[k]);
}

/* Mean of the first n answers, each weighted by R_j^-1 and its probability of belonging to cluster
 * k. Returns whether the center moved. */
static bool move_center(struct imle *m, int n, int k)
{
    struct imle_split_scratch *s = m->query.split;
    bool moved = false;

    for (int i = 0; i < m->D; i++) {
        double top = 0.0;
        double bottom = 0.0;
        m->kernels->weighted_sums(n, s->p[k], s->weight[i], s->x[i], &top, &bottom);
        if (!(bottom > 0.0))
            continue;
        double step = top / bottom - s->center[k][i];
        moved = moved || step * step * bottom > at_rest;
        s->center[k][i] = top / bottom;
    }
    return moved;
}

/* EM_pred: one iteration. p_jk is proportional to exp(-deviation / 2), over all clusters; the
 * deviations come from the centers before any has moved. Returns whether any has. */
static bool em_iteration(struct imle *m)
{
    struct imle_split_scratch *s = m->query.split;
    bool moved = false;

    all_deviations(m, s->heavy);
    memset(s->sum, 0, (size_t)s->heavy * sizeof(double));
    for (int k = 0; k < s->n; k++)
        m->kernels->memberships(s->heavy, s->p[k], s->nearest, s->sum);
    for (int k = 0; k < s->n; k++) {
        m->kernels->normalise(s->heavy, s->p[k], s->sum);
        moved = move_center(m, s->heavy, k) || moved;
    }
    return moved;
}

/* What the test of each cluster needs. */
static void sum_members(struct imle *m)
{
    struct imle_split_scratch *s = m->query.split;

    memset(s->T, 0, sizeof s->T);
    memset(s->t, 0, sizeof s->t);
    memset(s->tt, 0, sizeof s->tt);
    memset(s->members, 0, sizeof s->members);
    for (int a = 0; a < m->query.n_answers; a++) {
        const struct imle_answer *answer = &m->query.answers[s->index[a]];
        s->T[answer->cluster] += s->nearest[a];
        s->t[answer->cluster] += answer->t;
        s->tt[answer->cluster] += answer->t * answer->t;
        s->members[answer->cluster]++;
    }
}

/* Each answer goes to its most probable cluster; clusters that nobody chose are dropped. */
static void assign_answers(struct imle *m)
{
    struct imle_split_scratch *s = m->query.split;
    int renamed[LEARNER_MAX_SOLUTIONS] = {0};
    bool chosen[LEARNER_MAX_SOLUTIONS] = {false};
    int n = 0;

    all_deviations(m, s->padded);
    for (int a = 0; a < m->query.n_answers; a++) {
        int k = 0;
        while (s->p[k][a] > s->nearest[a])
            k++;
        m->query.answers[s->index[a]].cluster = k;
        chosen[k] = true;
    }
    for (int k = 0; k < s->n; k++) {
        renamed[k] = n;
        if (chosen[k])
            memmove(s->center[n++], s->center[k], sizeof s->center[k]);
    }
    for (int a = 0; a < m->query.n_answers; a++)
        m->query.answers[a].cluster = renamed[m->query.answers[a].cluster];
    s->n = n;
    sum_members(m);
}

/* How sure it is that cluster k is more than one; 0 when the significance is out of reach. */
static double split_level(const struct imle *m, int k)
{
    const struct imle_split_scratch *s = m->query.split;
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
    double *deviation = m->query.split->sum;
    double largest = -1.0;
    int farthest = 0;

    deviations(m, m->query.split->padded, x, deviation);
    for (int a = 0; a < m->query.n_answers; a++)
        if (m->query.answers[m->query.split->index[a]].cluster == k && deviation[a] > largest) {
            largest = deviation[a];
            farthest = a;
        }
    return m->query.split->index[farthest];
}

static void split_cluster(struct imle *m, int k)
{
    struct imle_split_scratch *s = m->query.split;
    int first = farthest_member(m, k, s->center[k]);
    int second = farthest_member(m, k, m->query.answers[first].xhat);
    bool moved = true;

    memcpy(s->center[k], m->query.answers[first].xhat, sizeof s->center[k]);
    memcpy(s->center[s->n++], m->query.answers[second].xhat, sizeof s->center[k]);
    for (int i = 0; i < m->config.em_pred_iterations && moved; i++) {
        if (i >= LEAST_STEPS && s->pairs > MOST_PAIRS)
            break;
        s->pairs += s->heavy * s->n;
        moved = em_iteration(m);
    }
    assign_answers(m);
}

/* The cluster with the largest level above the significance, or -1. */
static int cluster_to_split(const struct imle *m)
{
    double largest = m->config.significance;
    int worst = -1;

    for (int k = 0; k < m->query.split->n; k++) {
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
    struct imle_split_scratch *s = m->query.split;

    s->n = 1;
    s->pairs = 0;
    lay_out_answers(m);
    for (int a = 0; a < s->padded; a++)
        s->p[0][a] = 1.0;
    memset(s->center[0], 0, sizeof s->center[0]);
    (void)move_center(m, s->padded, 0);
    all_deviations(m, s->padded);
    sum_members(m);
    while (s->n < m->config.n_solutions_max) {
        int before = s->n;
        int worst = cluster_to_split(m);
        if (worst >= 0)
            split_cluster(m, worst);
        if (s->n <= before)
            break;
    }
    return s->n;
}
