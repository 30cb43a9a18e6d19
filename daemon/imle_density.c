/* What an expert answers and how sure it is of it, and what outliers are measured by. Everything is
 * in logarithms: far from all experts densities underflow, and their ratios still matter. */
#include <math.h>
#include <string.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"

static void center_features(struct imle *m, int j)
{
    const double *phibar = m->phibar + (size_t)j * (size_t)m->p;

    for (int k = 0; k < m->p; k++)
        m->offset[k] = m->phi[k] - phibar[k];
}

void imle_expert_output(struct imle *m, int j, double *xhat)
{
    const double *xbar = m->xbar + (size_t)j * (size_t)m->D;

    center_features(m, j);
    m->kernels->apply(m->p, m->D, m->W + (size_t)j * (size_t)m->p * (size_t)m->D, m->offset, xhat);
    for (int i = 0; i < m->D; i++)
        xhat[i] += xbar[i];
}

void imle_expert_slope(struct imle *m, int j)
{
    const double *W = m->W + (size_t)j * (size_t)m->p * (size_t)m->D;

    for (int i = 0; i < m->D; i++)
        m->kernels->apply(m->p, m->d, m->dphi, W + (size_t)i * (size_t)m->p,
                          m->slope + (size_t)i * (size_t)m->d);
}

double imle_expert_leverage(struct imle *m, int j)
{
    if (m->whitened == j)
        return m->leverage;
    center_features(m, j);
    m->kernels->whiten(m->p, m->whitener + (size_t)j * whitener_row(m->p), m->offset, m->white,
                       m->gain);
    m->whitened = j;
    m->leverage = m->kernels->dot(m->p, m->white, m->white);
    return m->leverage;
}

double imle_expert_gamma(struct imle *m, int j)
{
    return m->config.noise_share * (imle_expert_leverage(m, j) + 1.0 / m->strengths[j].S);
}

double imle_log_outlier_input(const struct imle *m)
{
    double value = m->log_c_input;

    for (int i = 0; i < m->d; i++)
        value -= 0.5 * elementary_log(m->sigma_bar[i]);
    return value;
}

double imle_log_outlier_joint(const struct imle *m)
{
    double value = imle_log_outlier_input(m) - m->log_c_input + m->log_c_joint;

    for (int i = 0; i < m->D; i++)
        value -= 0.5 * elementary_log(m->psi_bar[i]);
    return value;
}
