/* The experts of one cluster, averaged into one solution, and the derivative of that average.
 *
 * Shares phi_j: as published  t_j / (gamma_j t_j + W),  or, with a floor g0 on the uncertainty,
 * t_j / (W (gamma_j + g0)),  W = sum of the cluster's t + p_out(z). Value and variance are those of
 * weights phi_j / Psi_j, output by output. Everything is in units of the cluster's largest t. */
#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/imle/evidence.h"

static const double farthest = 1e100;

/* An expert whose share, or t, is less than this of the largest does not slope the solution: all of
 * them together change the Jacobian by less than their number times this of what theirs differ. */
static const double negligible_part_of_largest = 1e-8;

/* One cluster at work. */
struct fusion {
    int cluster;
    double scale; /* log of the cluster's largest t */
    double inside;
    double W;
    double dW[LEARNER_MAX_INPUTS];
    double largest_share;
    double sum_precision[LEARNER_MAX_OUTPUTS]; /* sum phi_j / Psi_ji */
};

static const double *psi_of(const struct imle *m, const struct imle_answer *answer)
{
    return m->state.psi + (size_t)answer->expert * (size_t)m->D;
}

/* t of the cluster's members in its own units, their sum, and how many they are. */
static int weigh_members(struct imle *m, struct fusion *fusion, double log_outlier)
{
    int members = 0;

    fusion->scale = -INFINITY;
    for (int a = 0; a < m->query.n_answers; a++)
        if (m->query.answers[a].cluster == fusion->cluster)
            fusion->scale = fmax(fusion->scale, m->query.answers[a].log_t);
    fusion->W = fmin(elementary_exp(log_outlier - fusion->scale), farthest);
    for (int a = 0; a < m->query.n_answers; a++) {
        struct imle_answer *answer = &m->query.answers[a];
        if (answer->cluster != fusion->cluster)
            continue;
        answer->t = elementary_exp(answer->log_t - fusion->scale);
        fusion->inside += answer->t;
        members++;
    }
    fusion->W += fusion->inside;
    return members;
}

/* Probability of the cluster among all answers and outliers, given the query alone. */
static double cluster_weight(const struct imle *m, const struct fusion *fusion)
{
    return fusion->inside * elementary_exp(fusion->scale - m->query.largest_log_t) / m->query.all_t;
}

static double share_of(const struct imle *m, const struct fusion *fusion,
                       const struct imle_answer *answer)
{
    double floor = m->config.gamma_floor;

    if (floor > 0.0)
        return answer->t / (fusion->W * (answer->gamma + floor));
    return answer->t / (answer->gamma * answer->t + fusion->W);
}

static void average_answers(struct imle *m, struct fusion *fusion,
                            struct learner_solution *solution)
{
    double sum[LEARNER_MAX_OUTPUTS] = {0.0};

    fusion->largest_share = -1.0;
    for (int a = 0; a < m->query.n_answers; a++) {
        struct imle_answer *answer = &m->query.answers[a];
        if (answer->cluster != fusion->cluster)
            continue;
        answer->share = share_of(m, fusion, answer);
        const double *psi = psi_of(m, answer);
        for (int i = 0; i < m->D; i++) {
            double precision = answer->share / psi[i];
            fusion->sum_precision[i] += precision;
            sum[i] += precision * answer->xhat[i];
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

/* Where births are by evidence, experts know what they have been wrong by: the variance is theirs,
 * by their parts in the solution, and what they differ from it. */
static void state_variance(const struct imle *m, const struct fusion *fusion,
                           struct learner_solution *solution)
{
    if (!(fusion->W < farthest))
        return;
    memset(solution->variance, 0, sizeof solution->variance);
    for (int a = 0; a < m->query.n_answers; a++) {
        const struct imle_answer *answer = &m->query.answers[a];
        if (answer->cluster != fusion->cluster)
            continue;
        double own[LEARNER_MAX_OUTPUTS];
        imle_stated_variances(m, answer->expert, answer->gamma, own);
        const double *psi = psi_of(m, answer);
        for (int i = 0; i < m->D; i++) {
            double off = answer->xhat[i] - solution->value[i];
            solution->variance[i] +=
                answer->share / psi[i] / fusion->sum_precision[i] * (own[i] + off * off);
        }
    }
}

/* d phi_j / d z */
static void share_slope(const struct imle *m, const struct fusion *fusion,
                        const struct imle_answer *answer, double *dshare)
{
    double t = answer->t;
    double floored = answer->gamma + m->config.gamma_floor;
    double published = answer->gamma * t + fusion->W;
    const double *kappa = answer->kappa;
    const double *dgamma = answer->dgamma;

    for (int i = 0; i < m->d; i++) {
        if (m->config.gamma_floor > 0.0)
            dshare[i] =
                -answer->share * (kappa[i] + fusion->dW[i] / fusion->W + dgamma[i] / floored);
        else
            dshare[i] =
                -answer->share * (fusion->W * kappa[i] + t * dgamma[i] + fusion->dW[i]) / published;
    }
}

/* kappa_j = (dof + d) / (a + q) Sigma^-1 (z - nu), so that d t_j = -t_j kappa_j; and
 * d W = - sum t_j kappa_j over the cluster. */
static void weight_slope(struct imle *m, struct fusion *fusion, const double *z)
{
    for (int a = 0; a < m->query.n_answers; a++) {
        struct imle_answer *answer = &m->query.answers[a];
        int j = answer->expert;
        if (answer->cluster != fusion->cluster || answer->t < negligible_part_of_largest)
            continue;
        double q = imle_gate_pull(m, j, z, answer->kappa);
        double factor = 2.0 * m->derived.gate.exponent[j] * m->derived.gate.per_a[j] /
                        (1.0 + q * m->derived.gate.per_a[j]);
        for (int i = 0; i < m->d; i++) {
            answer->kappa[i] *= factor;
            fusion->dW[i] -= answer->t * answer->kappa[i];
        }
    }
}

static void add_to_jacobian(struct imle *m, const struct fusion *fusion, struct imle_answer *answer,
                            struct learner_solution *solution)
{
    double dshare[LEARNER_MAX_INPUTS] = {0.0};

    imle_expert_slope(m, answer->expert);
    if (!m->config.average_jacobian) {
        imle_gamma_slope(m, answer);
        share_slope(m, fusion, answer, dshare);
    }
    for (int i = 0; i < m->D; i++) {
        double per = 1.0 / (psi_of(m, answer)[i] * fusion->sum_precision[i]);
        double difference = answer->xhat[i] - solution->value[i];
        for (int c = 0; c < m->d; c++)
            solution->jacobian[i * m->d + c] +=
                per * (answer->share * m->query.slope[i * m->d + c] + difference * dshare[c]);
    }
}

void imle_fuse(struct imle *m, const double *z, int cluster, double log_outlier,
               struct learner_solution *solution)
{
    struct fusion fusion = {.cluster = cluster};

    memset(solution, 0, sizeof *solution);
    solution->members = weigh_members(m, &fusion, log_outlier);
    solution->weight = cluster_weight(m, &fusion);
    average_answers(m, &fusion, solution);
    if (m->by_evidence)
        state_variance(m, &fusion, solution);
    if (!m->config.average_jacobian)
        weight_slope(m, &fusion, z);
    for (int a = 0; a < m->query.n_answers; a++) {
        struct imle_answer *answer = &m->query.answers[a];
        if (answer->cluster == cluster && answer->t >= negligible_part_of_largest &&
            answer->share >= negligible_part_of_largest * fusion.largest_share)
            add_to_jacobian(m, &fusion, answer, solution);
    }
}
