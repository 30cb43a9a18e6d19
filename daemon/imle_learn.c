/* One sample: is it known, whose is it, what do they learn from it (paper section 3). */
#include <math.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"

/* An expert whose share is bounded by exp(-this) of the rest is not looked at closely: all of them
 * together change a responsibility by less than M exp(-this), 1e-7 of it for 1000 experts. */
static const double negligible = 23.0;

/* The same in the sum that tells an outlier: it changes by less than 1e-8 of what decides. */
static const double negligible_density = 18.5;

/* Gating and features of the sample; false when its features are too large to compute with. */
static bool look_at(struct imle *m, const double *z, const double *x)
{
    imle_new_query(m, x);
    feature_map_evaluate(m->map, z, m->phi);
    for (int k = 0; k < m->p; k++)
        if (!(fabs(m->phi[k]) <= LEARNER_LARGEST_FEATURE))
            return false;
    imle_scan(m, z);
    return true;
}

/* p_j(z, x) in units of exp(log_unit), cut at e; m->log_h[j] is what its logarithm can be at most.
 */
static double joint_density(struct imle *m, int j, double log_unit)
{
    double inflation = 1.0 + imle_expert_gamma(m, j);
    double log_p = m->log_h[j] - log_unit - 0.5 * imle_expert_misfit(m, j) / inflation;

    if (log_p < -negligible)
        return 0.0;
    return elementary_exp(fmin(log_p - 0.5 * m->D * elementary_log(inflation), 1.0));
}

/* The first expert with that m->log_h. */
static int index_of(const struct imle *m, double log_h)
{
    int j = 0;

    while (j < m->M - 1 && m->log_h[j] < log_h)
        j++;
    return j;
}

/* m->log_h becomes the largest that log p_j(z, x) can be: the residual only lowers it. Returns the
 * expert where that is largest. */
static int bound_densities(struct imle *m)
{
    double largest = m->kernels->bounds(m->M, m->log_t, -1.0, m->gate.half_log_psi, m->log_h);

    return index_of(m, largest);
}

/* sum_j p_j(z, x) < p_out(z, x) / M. The gating alone tells which experts cannot matter; the sum
 * begins where most is to be expected, and ends as soon as it is large enough. */
static bool is_outlier(struct imle *m)
{
    if (m->M == 0)
        return true;
    double log_M = elementary_log(m->M);
    double threshold = imle_log_outlier_joint(m) - log_M;
    int best = bound_densities(m);
    double sum = joint_density(m, best, threshold);
    for (int j = 0; j < m->M && sum < 1.0; j++)
        if (j != best && m->log_h[j] >= threshold - log_M - negligible_density)
            sum += joint_density(m, j, threshold);
    return sum < 1.0;
}

/* The expert that a newborn takes its slopes from: largest log t_j + log S_h. -1 for none. */
static int parent_of_newborn(const struct imle *m)
{
    int parent = -1;

    for (int j = 0; m->config.inherit && j < m->M; j++)
        if (parent < 0 || m->log_t[j] + m->gate.log_S[j] > m->log_t[parent] + m->gate.log_S[parent])
            parent = j;
    return parent;
}

/* m->log_h becomes log h_j before normalising, were x met exactly; returns where it is largest. */
static int bound_responsibilities(struct imle *m)
{
    double largest = m->kernels->bounds(m->M, m->gate.log_peak, -0.5, m->q, m->log_h);

    return index_of(m, largest);
}

/* m->order lists the experts that may have a share, m->log_h their log h_j before normalising.
 * Returns how many; *largest is the largest. */
static int gather_shares(struct imle *m, double *largest)
{
    int best = bound_responsibilities(m);
    double best_log_h = m->log_h[best] - 0.5 * imle_expert_misfit(m, best);
    int n = 0;

    *largest = best_log_h;
    for (int j = 0; j < m->M; j++) {
        if (m->log_h[j] < *largest - negligible)
            continue;
        m->log_h[j] = j == best ? best_log_h : m->log_h[j] - 0.5 * imle_expert_misfit(m, j);
        *largest = m->log_h[j] > *largest ? m->log_h[j] : *largest;
        m->order[n++] = j;
    }
    return n;
}

/* The E-step, then the M-step of each expert with a share. `newborn` (or -1) learns whatever its
 * share, for an expert without weight predicts nothing. */
static void learn_shares(struct imle *m, const double *z, const double *x, int newborn)
{
    double largest = 0.0;
    int n = gather_shares(m, &largest);
    double sum = 0.0;

    if (newborn >= 0 && (n == 0 || m->order[n - 1] != newborn))
        m->order[n++] = newborn;
    for (int k = 0; k < n; k++)
        sum += elementary_exp(m->log_h[m->order[k]] - largest);
    for (int k = 0; k < n; k++) {
        int j = m->order[k];
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

    if (!look_at(m, z, x))
        return LEARNER_REFUSED;
    if (is_outlier(m)) {
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
