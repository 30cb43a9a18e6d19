/* The priors that all experts share: what a newborn should expect. */
#include <math.h>
#include <string.h>

#include "learner/imle/imle.h"

/* The positive root of  own sum y^2 - 2 t y - strength start = 0,  where own is each expert's
 * strength, strength that of the value `start` given by the user, and t = (M own - strength)/2 - 1.
 * In the form that does not cancel, whichever sign t has. */
static double shared_prior(int n_experts, double own, double strength, double start, double sum)
{
    if (isinf(own) || isinf(strength))
        return start;
    double t = 0.5 * (n_experts * own - strength) - 1.0;
    double root = sqrt(t * t + own * strength * start * sum);
    return t >= 0.0 ? (t + root) / (own * sum) : strength * start / (root - t);
}

/* The sums over one block of experts, anew: what an incremental sum would drift by, these do not,
 * and a loaded state has the same. */
static void sum_block(struct imle *m, int block)
{
    double *sums = m->derived.prior_sums + (size_t)(block * (m->d + m->D));
    int end = (block + 1) * IMLE_SUM < m->state.M ? (block + 1) * IMLE_SUM : m->state.M;

    memset(sums, 0, (size_t)(m->d + m->D) * sizeof *sums);
    for (int j = block * IMLE_SUM; j < end; j++) {
        if (imle_vacant(m, j))
            continue;
        for (int i = 0; i < m->d; i++)
            sums[i] += m->derived.precision[j * m->d + i];
        for (int i = 0; i < m->D; i++)
            sums[m->d + i] += 1.0 / m->state.psi[j * m->D + i];
    }
    m->derived.stale[block] = false;
}

void imle_priors_update(struct imle *m)
{
    const struct learner_config *config = &m->config;
    double precision[LEARNER_MAX_INPUTS] = {0.0};
    double per_psi[LEARNER_MAX_OUTPUTS] = {0.0};
    int n = imle_experts(m);

    if (n == 0)
        return;
    for (int block = 0; block * IMLE_SUM < m->state.M; block++) {
        const double *sums = m->derived.prior_sums + (size_t)(block * (m->d + m->D));
        if (m->derived.stale[block])
            sum_block(m, block);
        for (int i = 0; i < m->d; i++)
            precision[i] += sums[i];
        for (int i = 0; i < m->D; i++)
            per_psi[i] += sums[m->d + i];
    }
    for (int i = 0; i < m->d; i++)
        m->state.sigma_bar[i] = shared_prior(n, config->prior_sigma, config->hyper_sigma,
                                             config->sigma0[i], precision[i]);
    for (int i = 0; i < m->D && !m->by_evidence; i++)
        m->state.psi_bar[i] =
            shared_prior(n, config->prior_psi, config->hyper_psi, config->psi0[i], per_psi[i]);
}
