/* Clusters by splitting: as long as the members of one disagree more than chance allows, it is
 * split in two (paper section 3; the published rule, and its variant with other variances). */
#include <math.h>
#include <string.h>

#include "daemon/elementary.h"
#include "daemon/imle_chi2.h"
#include "daemon/imle_private.h"

struct centers {
    int n;
    double x[LEARNER_MAX_SOLUTIONS][LEARNER_MAX_OUTPUTS];
};

/* (xhat_j - x)' R_j^-1 (xhat_j - x) */
static double deviation(const struct imle *m, const struct imle_answer *answer, const double *x)
{
    const double *psi = m->psi + (size_t)answer->expert * (size_t)m->D;
    double sum = 0.0;

    for (int i = 0; i < m->D; i++)
        sum += (answer->xhat[i] - x[i]) * (answer->xhat[i] - x[i]) / psi[i];
    return sum / answer->spread;
}

/* Mean of all answers, each weighted by R_j^-1 and its probability of belonging to cluster k. */
static void move_center(const struct imle *m, struct centers *centers, int k,
                        const double *probability)
{
    double sum[LEARNER_MAX_OUTPUTS] = {0.0};
    double weights[LEARNER_MAX_OUTPUTS] = {0.0};

    for (int a = 0; a < m->n_answers; a++) {
        const struct imle_answer *answer = &m->answers[a];
        const double *psi = m->psi + (size_t)answer->expert * (size_t)m->D;
        for (int i = 0; i < m->D; i++) {
            double weight = (probability ? probability[a] : 1.0) / (answer->spread * psi[i]);
            sum[i] += weight * answer->xhat[i];
            weights[i] += weight;
        }
    }
    for (int i = 0; i < m->D; i++)
        if (weights[i] > 0.0)
            centers->x[k][i] = sum[i] / weights[i];
}

/* EM_pred: one iteration. p_jk is proportional to exp(-deviation / 2), over all clusters; the
 * deviations come from the centers before any has moved. */
static void em_iteration(struct imle *m, struct centers *centers)
{
    struct centers before = *centers;
    double *nearest =
        m->log_h; /* of each answer: its smallest deviation, then sum of exponentials */
    double *sum = m->log_t;
    double *probability = m->q;

    for (int a = 0; a < m->n_answers; a++) {
        nearest[a] = INFINITY;
        sum[a] = 0.0;
        for (int k = 0; k < before.n; k++)
            nearest[a] = fmin(nearest[a], deviation(m, &m->answers[a], before.x[k]));
        for (int k = 0; k < before.n; k++)
            sum[a] +=
                elementary_exp(-0.5 * (deviation(m, &m->answers[a], before.x[k]) - nearest[a]));
    }
    for (int k = 0; k < before.n; k++) {
        for (int a = 0; a < m->n_answers; a++)
            probability[a] =
                elementary_exp(-0.5 * (deviation(m, &m->answers[a], before.x[k]) - nearest[a])) /
                sum[a];
        move_center(m, centers, k, probability);
    }
}

/* Each answer goes to its most probable cluster; clusters that nobody chose are dropped. */
static void assign(struct imle *m, struct centers *centers)
{
    int members[LEARNER_MAX_SOLUTIONS] = {0};
    int renamed[LEARNER_MAX_SOLUTIONS] = {0};
    int n = 0;

    for (int a = 0; a < m->n_answers; a++) {
        struct imle_answer *answer = &m->answers[a];
        answer->cluster = 0;
        for (int k = 1; k < centers->n; k++)
            if (deviation(m, answer, centers->x[k]) <
                deviation(m, answer, centers->x[answer->cluster]))
                answer->cluster = k;
        members[answer->cluster]++;
    }
    for (int k = 0; k < centers->n; k++) {
        renamed[k] = n;
        if (members[k] > 0)
            memmove(centers->x[n++], centers->x[k], sizeof centers->x[k]);
    }
    for (int a = 0; a < m->n_answers; a++)
        m->answers[a].cluster = renamed[m->answers[a].cluster];
    centers->n = n;
}

/* How sure it is that cluster k is more than one. */
static double split_level(const struct imle *m, const struct centers *centers, int k)
{
    double T = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    int members = 0;

    for (int a = 0; a < m->n_answers; a++) {
        const struct imle_answer *answer = &m->answers[a];
        if (answer->cluster != k)
            continue;
        T += deviation(m, answer, centers->x[k]);
        sum += answer->t;
        squares += answer->t * answer->t;
        members++;
    }
    if (members < 2)
        return 0.0;
    if (m->config.clustering == LEARNER_CLUSTER_SPLIT)
        return chi2_cdf((members - 1) * m->D, T);
    return chi2_cdf((sum * sum / squares - 1.0) * m->D + 1.0, T);
}

/* The member of cluster k that is farthest from x. */
static int farthest_member(const struct imle *m, int k, const double *x)
{
    int farthest = -1;
    double largest = -1.0;

    for (int a = 0; a < m->n_answers; a++) {
        if (m->answers[a].cluster != k)
            continue;
        double distance = deviation(m, &m->answers[a], x);
        if (distance > largest) {
            largest = distance;
            farthest = a;
        }
    }
    return farthest;
}

static void split(struct imle *m, struct centers *centers, int k)
{
    int first = farthest_member(m, k, centers->x[k]);
    int second = farthest_member(m, k, m->answers[first].xhat);

    memcpy(centers->x[k], m->answers[first].xhat, sizeof centers->x[k]);
    memcpy(centers->x[centers->n++], m->answers[second].xhat, sizeof centers->x[k]);
    for (int i = 0; i < m->config.em_pred_iterations; i++)
        em_iteration(m, centers);
    assign(m, centers);
}

/* The cluster with the largest level above the significance, or -1. */
static int cluster_to_split(const struct imle *m, const struct centers *centers)
{
    double largest = m->config.significance;
    int worst = -1;

    for (int k = 0; k < centers->n; k++) {
        double level = split_level(m, centers, k);
        if (level > largest) {
            largest = level;
            worst = k;
        }
    }
    return worst;
}

int imle_cluster_by_splitting(struct imle *m)
{
    struct centers centers = {.n = 1};

    move_center(m, &centers, 0, NULL);
    while (centers.n < m->config.n_solutions_max) {
        int before = centers.n;
        int worst = cluster_to_split(m, &centers);
        if (worst >= 0)
            split(m, &centers, worst);
        if (centers.n <= before)
            break;
    }
    return centers.n;
}
