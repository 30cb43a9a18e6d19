/* All values of the map at a query: every expert's answer, gathered into clusters, each cluster
 * averaged into one solution (paper section 3, multi-valued prediction). */
#include <math.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"

/* An expert whose weight is below exp(-this) of the largest changes nothing in double precision. */
static const double negligible = 40.0;

/* p_out(z) in units of the largest t is cut here: beyond it a solution has no weight anyway. */
static const double farthest = 1e100;

/* Gating and features of the query; false when there is nothing to predict from. */
static bool look_at(struct imle *m, const double *z)
{
    if (m->M == 0)
        return false;
    feature_map_evaluate(m->map, z, m->phi);
    for (int k = 0; k < m->p; k++)
        if (!(fabs(m->phi[k]) <= LEARNER_LARGEST_FEATURE))
            return false;
    feature_map_derivative(m->map, z, m->phi, m->dphi);
    for (int j = 0; j < m->M; j++) {
        m->q[j] = imle_distance(m, j, z);
        m->log_t[j] = imle_log_t(m, j, m->q[j]);
    }
    return true;
}

/* log tau_j: t_j without its determinant, so that narrow experts do not outshout wide ones. */
static double log_tau(const struct imle *m, int j)
{
    return m->log_t[j] - m->gate[j].log_norm;
}

static double largest_log_t(const struct imle *m)
{
    double largest = -INFINITY;

    for (int j = 0; j < m->M; j++)
        largest = fmax(largest, m->log_t[j]);
    return largest;
}

static double largest_log_tau(const struct imle *m)
{
    double largest = -INFINITY;

    for (int j = 0; j < m->M; j++)
        largest = fmax(largest, log_tau(m, j));
    return largest;
}

static void add_answer(struct imle *m, int j, double t)
{
    struct imle_answer *answer = &m->answers[m->n_answers++];

    answer->expert = j;
    answer->cluster = 0;
    answer->q = m->q[j];
    answer->log_t = m->log_t[j];
    answer->t = t;
    answer->gamma = imle_expert_gamma(m, j);
    imle_expert_output(m, j, answer->xhat);
}

/* Answers with the published variance R_j = Psi_j (gamma_j + W / t_j). */
static void gather_published(struct imle *m, double largest, double outlier)
{
    double W = outlier;

    m->n_answers = 0;
    for (int j = 0; j < m->M; j++)
        if (m->log_t[j] >= largest - negligible)
            add_answer(m, j, elementary_exp(m->log_t[j] - largest));
    for (int k = 0; k < m->n_answers; k++)
        W += m->answers[k].t;
    for (int k = 0; k < m->n_answers; k++)
        m->answers[k].spread = m->answers[k].gamma + W / m->answers[k].t;
}

/* Answers with R_j = Psi_j (1 + gamma_j) / (tau_j / max tau)^kappa. Whoever has too large an R
 * could only ever follow another: left out. */
static void gather_by_distance(struct imle *m, double largest)
{
    double kappa = m->config.kappa;
    double nearest = largest_log_tau(m);

    m->n_answers = 0;
    for (int j = 0; j < m->M; j++) {
        double far = kappa * (nearest - log_tau(m, j));
        if (far > negligible)
            continue;
        add_answer(m, j, elementary_exp(m->log_t[j] - largest));
        struct imle_answer *answer = &m->answers[m->n_answers - 1];
        answer->spread = (1.0 + answer->gamma) * elementary_exp(far);
    }
}

static int cluster(struct imle *m, double largest, double outlier)
{
    if (m->config.clustering == LEARNER_CLUSTER_PUBLISHED)
        gather_published(m, largest, outlier);
    else
        gather_by_distance(m, largest);
    if (m->config.clustering == LEARNER_CLUSTER_LEADER)
        return imle_cluster_by_leaders(m);
    return imle_cluster_by_splitting(m);
}

/* Strongest first; of equals the one whose principal expert is older. */
static void sort_solutions(struct learner_solution *solution, int n)
{
    for (int i = 0; i < n; i++) {
        int best = i;
        for (int k = i + 1; k < n; k++)
            if (solution[k].weight > solution[best].weight ||
                (solution[k].weight >= solution[best].weight &&
                 solution[k].principal < solution[best].principal))
                best = k;
        struct learner_solution swap = solution[i];
        solution[i] = solution[best];
        solution[best] = swap;
    }
}

int imle_predict(struct imle *m, const double *z, struct learner_prediction *prediction)
{
    if (!look_at(m, z))
        return 0;
    double largest = largest_log_t(m);
    double log_outlier = imle_log_outlier_input(m);
    int n = cluster(m, largest, fmin(elementary_exp(log_outlier - largest), farthest));
    for (int k = 0; k < n; k++)
        imle_fuse(m, z, k, log_outlier, &prediction->solution[k]);
    sort_solutions(prediction->solution, n);
    return n;
}

int imle_predict_single(struct imle *m, const double *z, struct learner_solution *solution)
{
    if (!look_at(m, z))
        return 0;
    double largest = largest_log_t(m);
    double log_outlier = imle_log_outlier_input(m);
    gather_published(m, largest, fmin(elementary_exp(log_outlier - largest), farthest));
    imle_fuse(m, z, 0, log_outlier, solution);
    return 1;
}
