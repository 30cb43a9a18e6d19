/* The experts of one cluster, averaged into one solution, and the derivative of that average.
 *
 * Shares phi_j: as published  t_j / (gamma_j t_j + W),  or, with a floor g0 on the uncertainty,
 * t_j / (W (gamma_j + g0)),  W = sum of the cluster's t + p_out(z). Value and variance are those of
 * weights phi_j / Psi_j, output by output. Everything is in units of the cluster's largest t. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"
#include "daemon/imle_triangle.h"

static const double farthest = 1e100;

/* One cluster at work. */
struct fusion {
    int cluster;
    double scale; /* log of the cluster's largest t */
    double W;
    double dW[LEARNER_MAX_INPUTS];
    double largest_share;
    double sum_precision[LEARNER_MAX_OUTPUTS]; /* sum phi_j / Psi_ji */
};

static const double *psi_of(const struct imle *m, const struct imle_answer *answer)
{
    return m->psi + (size_t)answer->expert * (size_t)m->D;
}

/* t of the cluster's members in its own units, their sum, and how many they are. */
static int weigh_members(struct imle *m, struct fusion *fusion, double log_outlier)
{
    int members = 0;

    fusion->scale = -INFINITY;
    for (int a = 0; a < m->n_answers; a++)
        if (m->answers[a].cluster == fusion->cluster)
            fusion->scale = fmax(fusion->scale, m->answers[a].log_t);
    fusion->W = fmin(elementary_exp(log_outlier - fusion->scale), farthest);
    for (int a = 0; a < m->n_answers; a++) {
        struct imle_answer *answer = &m->answers[a];
        if (answer->cluster != fusion->cluster)
            continue;
        answer->t = elementary_exp(answer->log_t - fusion->scale);
        fusion->W += answer->t;
        members++;
    }
    return members;
}

/* Probability of the cluster among all answers and outliers, given the query alone. */
static double cluster_weight(const struct imle *m, const struct fusion *fusion, double log_outlier)
{
    double inside = 0.0;
    double all = fmin(elementary_exp(log_outlier - fusion->scale), farthest);

    for (int a = 0; a < m->n_answers; a++) {
        double t = fmin(elementary_exp(m->answers[a].log_t - fusion->scale), farthest);
        all += t;
        inside += m->answers[a].cluster == fusion->cluster ? t : 0.0;
    }
    return inside / all;
}

static double share_of(const struct imle *m, const struct fusion *fusion,
                       const struct imle_answer *answer)
{
    double floor = m->config.gamma_floor;

    if (floor > 0.0)
        return answer->t / (fusion->W * (answer->gamma + floor));
    return answer->t / (answer->gamma * answer->t + fusion->W);
}

static void average(struct imle *m, struct fusion *fusion, struct learner_solution *solution)
{
    double sum[LEARNER_MAX_OUTPUTS] = {0.0};

    fusion->largest_share = -1.0;
    for (int a = 0; a < m->n_answers; a++) {
        struct imle_answer *answer = &m->answers[a];
        if (answer->cluster != fusion->cluster)
            continue;
        answer->share = share_of(m, fusion, answer);
        for (int i = 0; i < m->D; i++) {
            fusion->sum_precision[i] += answer->share / psi_of(m, answer)[i];
            sum[i] += answer->share / psi_of(m, answer)[i] * answer->xhat[i];
        }
        if (answer->share > fusion->largest_share) {
            fusion->largest_share = answer->share;
            solution->principal = answer->expert;
        }
    }
    for (int i = 0; i < m->D; i++) {
        solution->value[i] = sum[i] / fusion->sum_precision[i];
        solution->variance[i] =
            fusion->W < farthest ? 1.0 / fusion->sum_precision[i] : (double)INFINITY;
    }
}

/* kappa_j = (dof + d) / (a + q) Sigma^-1 (z - nu), so that d t_j = -t_j kappa_j. */
static void gate_slope(const struct imle *m, const struct imle_answer *answer, const double *z,
                       double *kappa)
{
    const struct imle_gate *gate = &m->gate[answer->expert];
    const double *nu = m->nu + (size_t)answer->expert * (size_t)m->d;
    const double *root = m->root + (size_t)answer->expert * triangle_size(m->d);
    double offset[LEARNER_MAX_INPUTS];
    double y[LEARNER_MAX_INPUTS];

    for (int i = 0; i < m->d; i++)
        offset[i] = z[i] - nu[i];
    triangle_multiply(m->d, root, offset, y);
    triangle_multiply_transposed(m->d, root, y, kappa);
    for (int i = 0; i < m->d; i++)
        kappa[i] *= 2.0 * gate->exponent / (gate->a + answer->q);
}

/* d gamma_j = 2 noise_share (d phi / d z)' C^-1 (phi - phibar) */
static void gamma_slope(struct imle *m, const struct imle_answer *answer, double *dgamma)
{
    (void)imle_expert_leverage(m, answer->expert);
    triangle_solve_transposed(m->p, m->factor + (size_t)answer->expert * triangle_size(m->p),
                              m->gain);
    for (int i = 0; i < m->d; i++)
        dgamma[i] = 0.0;
    for (int k = 0; k < m->p; k++)
        for (int i = 0; i < m->d; i++)
            dgamma[i] += 2.0 * m->config.noise_share * m->dphi[k * m->d + i] * m->gain[k];
}

/* d phi_j / d z */
static void share_slope(struct imle *m, const struct fusion *fusion,
                        const struct imle_answer *answer, const double *z, double *dshare)
{
    double t = answer->t;
    double floored = answer->gamma + m->config.gamma_floor;
    double published = answer->gamma * t + fusion->W;
    double kappa[LEARNER_MAX_INPUTS];
    double dgamma[LEARNER_MAX_INPUTS];

    gate_slope(m, answer, z, kappa);
    gamma_slope(m, answer, dgamma);
    for (int i = 0; i < m->d; i++) {
        if (m->config.gamma_floor > 0.0)
            dshare[i] =
                -answer->share * (kappa[i] + fusion->dW[i] / fusion->W + dgamma[i] / floored);
        else
            dshare[i] =
                -answer->share * (fusion->W * kappa[i] + t * dgamma[i] + fusion->dW[i]) / published;
    }
}

/* d W = - sum t_j kappa_j over the cluster */
static void weight_slope(const struct imle *m, struct fusion *fusion, const double *z)
{
    double kappa[LEARNER_MAX_INPUTS];

    for (int a = 0; a < m->n_answers; a++) {
        if (m->answers[a].cluster != fusion->cluster)
            continue;
        gate_slope(m, &m->answers[a], z, kappa);
        for (int i = 0; i < m->d; i++)
            fusion->dW[i] -= m->answers[a].t * kappa[i];
    }
}

static void add_to_jacobian(struct imle *m, const struct fusion *fusion,
                            const struct imle_answer *answer, const double *z,
                            struct learner_solution *solution)
{
    double dshare[LEARNER_MAX_INPUTS] = {0.0};

    imle_expert_slope(m, answer->expert);
    if (!m->config.average_jacobian)
        share_slope(m, fusion, answer, z, dshare);
    for (int i = 0; i < m->D; i++) {
        double per = 1.0 / (psi_of(m, answer)[i] * fusion->sum_precision[i]);
        double difference = answer->xhat[i] - solution->value[i];
        for (int c = 0; c < m->d; c++)
            solution->jacobian[i * m->d + c] +=
                per * (answer->share * m->slope[i * m->d + c] + difference * dshare[c]);
    }
}

void imle_fuse(struct imle *m, const double *z, int cluster, double log_outlier,
               struct learner_solution *solution)
{
    struct fusion fusion = {.cluster = cluster};

    memset(solution, 0, sizeof *solution);
    solution->members = weigh_members(m, &fusion, log_outlier);
    solution->weight = cluster_weight(m, &fusion, log_outlier);
    average(m, &fusion, solution);
    weight_slope(m, &fusion, z);
    for (int a = 0; a < m->n_answers; a++) {
        const struct imle_answer *answer = &m->answers[a];
        /* A share below the rounding of the largest adds nothing but work. */
        if (answer->cluster == cluster && answer->share >= DBL_EPSILON * fusion.largest_share)
            add_to_jacobian(m, &fusion, answer, z, solution);
    }
}
