/* One sample: is it known, whose is it, what do they learn from it (paper section 3). */
#include <math.h>

#include "common/base/elementary.h"
#include "learner/imle/evidence.h"

/* An expert whose share is bounded by exp(-this) of the rest is not looked at closely: all of them
 * together change a responsibility by less than M exp(-this), 1e-10 of it for 1000 experts. */
static const double negligible_under_largest_share = 30.0;

/* The same in the sum that tells an outlier: it changes by less than 1e-8 of what decides. */
static const double negligible_under_outlier = 18.5;

/* A density under exp(-this) of what decides counts as nothing in that sum. */
static const double vanishing_under_outlier = 30.0;

/* Who may have a share in the sample: m->query.order[0 .. n), and their log h_j before normalising
 * in m->query.log_h. */
struct shares {
    int n;
    int best; /* the expert with the largest share, or -1 */
    double largest;
};

bool imle_look_at_sample(struct imle *m, const double *z, const double *x)
{
    imle_new_query(m, x);
    feature_map_evaluate(m->map, z, m->query.phi);
    for (int k = 0; k < m->p; k++)
        if (!(fabs(m->query.phi[k]) <= LEARNER_LARGEST_FEATURE))
            return false;
    imle_scan_distances(m, z);
    return true;
}

/* What log p_j(z, x) can be at most: the residual only lowers it. */
static double most_density(const struct imle *m, int j)
{
    return m->query.log_t[j] - m->derived.gate.half_log_psi[j];
}

/* p_j(z, x) in units of exp(log_unit), cut at e. */
static double joint_density(struct imle *m, int j, double log_unit)
{
    double inflation = 1.0 + imle_expert_gamma(m, j);
    double log_p = most_density(m, j) - log_unit - 0.5 * imle_expert_misfit(m, j) / inflation;

    if (log_p < -vanishing_under_outlier)
        return 0.0;
    return elementary_exp(fmin(log_p - 0.5 * m->D * elementary_log(inflation), 1.0));
}

/* sum_j p_j(z, x) < p_out(z, x) / M. The expert with the largest share mostly decides alone; of the
 * others the gating tells which cannot matter, and the sum ends as soon as it is large enough. */
static bool is_outlier(struct imle *m, int best)
{
    if (best < 0)
        return true;
    double log_M = elementary_log(m->state.M);
    double threshold = imle_log_outlier_joint(m) - log_M;
    imle_density_near(m, best);
    double sum = joint_density(m, best, threshold);
    if (sum >= 1.0)
        return false;
    imle_densities(m);
    for (int j = 0; j < m->state.M && sum < 1.0; j++)
        if (j != best && most_density(m, j) >= threshold - log_M - negligible_under_outlier)
            sum += joint_density(m, j, threshold);
    return sum < 1.0;
}

int imle_parent_of_newborn(const struct imle *m)
{
    int parent = -1;

    for (int j = 0; m->config.inherit && j < m->state.M; j++)
        if (imle_vacant(m, j))
            continue;
        else if (parent < 0 || m->query.log_t[j] + m->derived.gate.log_S[j] >
                                   m->query.log_t[parent] + m->derived.gate.log_S[parent])
            parent = j;
    return parent;
}

/* m->query.log_h becomes what log h_j were if each expert met x exactly: an upper bound. Returns
 * where it is largest. */
static int bound_shares(struct imle *m)
{
    double largest =
        m->kernels->bounds(m->state.M, m->derived.gate.log_peak, -0.5, m->query.q, m->query.log_h);
    int j = 0;

    while (j < m->state.M - 1 && m->query.log_h[j] < largest)
        j++;
    return j;
}

/* log h_j of n neighbours from j on, all in one block where experts answer in blocks. */
static void share_out(struct imle *m, int j, int n, struct shares *shares)
{
    const double *misfits = imle_expert_misfits(m, j);
    double top = m->kernels->bounds(n, m->query.log_h + j, -0.5, misfits, m->query.log_h + j);

    if (top <= shares->largest)
        return;
    shares->largest = top;
    while (m->query.log_h[j] < top)
        j++;
    shares->best = j;
}

static bool any_over(const double *values, int n, double limit)
{
    for (int i = 0; i < n; i++)
        if (values[i] >= limit)
            return true;
    return false;
}

/* Begins where most is to be expected; an expert whose bound, or share, is negligible beside the
 * largest of the shares met so far is so beside the largest of all. */
static struct shares gather_shares(struct imle *m)
{
    int step = m->small ? KERNEL_LANES : 1;
    struct shares shares = {.best = -1};

    if (m->state.M == 0)
        return shares;
    shares.best = bound_shares(m);
    shares.largest = m->query.log_h[shares.best] - 0.5 * imle_expert_misfit(m, shares.best);
    for (int j = 0; j < m->state.M; j += step) {
        int n = m->state.M - j < step ? m->state.M - j : step;
        if (any_over(m->query.log_h + j, n, shares.largest - negligible_under_largest_share))
            share_out(m, j, n, &shares);
    }
    for (int j = 0; j < m->state.M; j++)
        if (m->query.log_h[j] >= shares.largest - negligible_under_largest_share)
            m->query.order[shares.n++] = j;
    return shares;
}

/* The E-step, then the M-step of each expert with a share. `newborn` (or -1) learns whatever its
 * share, for an expert without weight predicts nothing. */
static void learn_shares(struct imle *m, struct shares shares, int newborn, const double *z,
                         const double *x)
{
    double sum = 0.0;

    if (newborn >= 0 && (shares.n == 0 || m->query.order[shares.n - 1] != newborn))
        m->query.order[shares.n++] = newborn;
    for (int k = 0; k < shares.n; k++) {
        int j = m->query.order[k];
        m->query.h[j] = elementary_exp(m->query.log_h[j] - shares.largest);
        sum += m->query.h[j];
    }
    for (int k = 0; k < shares.n; k++) {
        int j = m->query.order[k];
        double h = m->query.h[j] / sum;
        if (j == newborn)
            h = fmax(h, 1e-3);
        if (h > m->config.skip)
            imle_expert_update(m, j, h, z, x);
    }
}

enum learner_update_result imle_learn(struct imle *m, const double *z, const double *x)
{
    int newborn = -1;

    if (m->by_evidence)
        return imle_learn_by_evidence(m, z, x);
    if (!imle_look_at_sample(m, z, x))
        return LEARNER_REFUSED;
    struct shares shares = gather_shares(m);
    if (is_outlier(m, shares.best)) {
        if (m->state.outliers_in_row < m->config.n_outliers) {
            m->state.outliers_in_row++;
            return LEARNER_OUTLIER;
        }
        if (m->state.M == m->config.capacity)
            return LEARNER_FULL;
        newborn = m->state.M;
        imle_expert_birth(m, m->state.M++, z, x, imle_parent_of_newborn(m));
        m->query.q[newborn] = 0.0;
        shares = gather_shares(m);
    }
    m->state.outliers_in_row = 0;
    learn_shares(m, shares, newborn, z, x);
    imle_priors_update(m);
    return newborn >= 0 ? LEARNER_BORN : LEARNER_UPDATED;
}
