/* One sample: is it known, whose is it, what do they learn from it (paper section 3). */
#include <math.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"

/* Experts whose share is below exp(-this) of what decides are not looked at closely. */
static const double negligible = 40.0;

/* Gating and features of the sample; false when its features are too large to compute with. */
static bool look_at(struct imle *m, const double *z)
{
    feature_map_evaluate(m->map, z, m->phi);
    for (int k = 0; k < m->p; k++)
        if (!(fabs(m->phi[k]) <= LEARNER_LARGEST_FEATURE))
            return false;
    for (int j = 0; j < m->M; j++) {
        m->q[j] = imle_distance(m, j, z);
        m->log_t[j] = imle_log_t(m, j, m->q[j]);
    }
    return true;
}

/* sum (x - xhat)^2 / Psi of expert j. */
static double misfit(const struct imle *m, int j, const double *x)
{
    const double *psi = m->psi + (size_t)j * (size_t)m->D;
    double xhat[LEARNER_MAX_OUTPUTS];
    double sum = 0.0;

    imle_expert_output(m, j, xhat);
    for (int i = 0; i < m->D; i++)
        sum += (x[i] - xhat[i]) * (x[i] - xhat[i]) / psi[i];
    return sum;
}

/* sum_j p_j(z, x) < p_out(z, x) / M. The residual only lowers p_j, so that the gating alone tells
 * which experts cannot matter; the sum ends as soon as it is large enough. */
static bool is_outlier(struct imle *m, const double *x)
{
    if (m->M == 0)
        return true;
    double threshold = imle_log_outlier_joint(m) - elementary_log(m->M);
    double sum = 0.0;
    for (int j = 0; j < m->M && sum < 1.0; j++) {
        double bound = m->log_t[j] - m->gate[j].half_log_psi;
        if (bound < threshold - elementary_log(m->M) - negligible)
            continue;
        double inflation = 1.0 + imle_expert_gamma(m, j);
        double log_p =
            bound - 0.5 * m->D * elementary_log(inflation) - 0.5 * misfit(m, j, x) / inflation;
        sum += elementary_exp(fmin(log_p - threshold, 1.0));
    }
    return sum < 1.0;
}

/* The expert that a newborn takes its slopes from: largest log t_j + log S_h. -1 for none. */
static int parent_of_newborn(const struct imle *m)
{
    int parent = -1;

    for (int j = 0; m->config.inherit && j < m->M; j++)
        if (parent < 0 || m->log_t[j] + m->gate[j].log_S > m->log_t[parent] + m->gate[parent].log_S)
            parent = j;
    return parent;
}

/* log h_j before normalising, for experts that may have a share; the others get -INFINITY. Returns
 * the largest. */
static double log_responsibilities(struct imle *m, const double *x)
{
    double largest = -INFINITY;

    for (int j = 0; j < m->M; j++) {
        double bound = m->gate[j].log_det - 0.5 * m->q[j] - m->gate[j].half_log_psi;
        m->log_h[j] = -INFINITY;
        if (bound < largest - negligible)
            continue;
        m->log_h[j] = bound - 0.5 * misfit(m, j, x);
        largest = fmax(largest, m->log_h[j]);
    }
    return largest;
}

/* The E-step, then the M-step of each expert with a share. `newborn` (or -1) learns whatever its
 * share, for an expert without weight predicts nothing. */
static void learn_shares(struct imle *m, const double *z, const double *x, int newborn)
{
    double largest = log_responsibilities(m, x);
    double sum = 0.0;

    for (int j = 0; j < m->M; j++)
        sum += elementary_exp(m->log_h[j] - largest);
    for (int j = 0; j < m->M; j++) {
        double h = elementary_exp(m->log_h[j] - largest) / sum;
        if (j == newborn)
            h = fmax(h, 1e-3);
        if (h > m->config.skip)
            imle_expert_update(m, j, h, z, x);
    }
}

enum learner_update_result imle_learn(struct imle *m, const double *z, const double *x)
{
    int newborn = -1;

    if (!look_at(m, z))
        return LEARNER_REFUSED;
    if (is_outlier(m, x)) {
        if (m->outliers_in_row < m->config.n_outliers) {
            m->outliers_in_row++;
            return LEARNER_OUTLIER;
        }
        if (m->M == m->config.capacity)
            return LEARNER_FULL;
        newborn = m->M;
        imle_expert_birth(m, z, x, parent_of_newborn(m));
        m->q[newborn] = 0.0;
    }
    m->outliers_in_row = 0;
    learn_shares(m, z, x, newborn);
    imle_priors_update(m);
    return newborn >= 0 ? LEARNER_BORN : LEARNER_UPDATED;
}
