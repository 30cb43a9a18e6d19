/* How well an expert explains a point. Everything is in logarithms: far from all experts densities
 * underflow, and their ratios still matter. */
#include <math.h>
#include <string.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"
#include "daemon/imle_triangle.h"

double imle_distance(const struct imle *m, int j, const double *z)
{
    const double *nu = m->nu + (size_t)j * (size_t)m->d;
    const double *root = m->root + (size_t)j * triangle_size(m->d);
    double offset[LEARNER_MAX_INPUTS];
    double y[LEARNER_MAX_INPUTS];

    for (int i = 0; i < m->d; i++)
        offset[i] = z[i] - nu[i];
    triangle_multiply(m->d, root, offset, y);
    return triangle_dot(m->d, y, y);
}

double imle_log_t(const struct imle *m, int j, double q)
{
    const struct imle_gate *gate = &m->gate[j];

    return gate->log_norm - gate->exponent * elementary_log1p(q / gate->a);
}

void imle_expert_output(const struct imle *m, int j, double *xhat)
{
    const double *phibar = m->phibar + (size_t)j * (size_t)m->p;
    const double *xbar = m->xbar + (size_t)j * (size_t)m->D;
    const double *W = m->W + (size_t)j * (size_t)m->p * (size_t)m->D;

    for (int i = 0; i < m->D; i++)
        xhat[i] = xbar[i];
    for (int k = 0; k < m->p; k++)
        for (int i = 0; i < m->D; i++)
            xhat[i] += W[k * m->D + i] * (m->phi[k] - phibar[k]);
}

void imle_expert_slope(struct imle *m, int j)
{
    const double *W = m->W + (size_t)j * (size_t)m->p * (size_t)m->D;

    memset(m->slope, 0, (size_t)(m->D * m->d) * sizeof *m->slope);
    for (int k = 0; k < m->p; k++)
        for (int i = 0; i < m->D; i++)
            for (int c = 0; c < m->d; c++)
                m->slope[i * m->d + c] += W[k * m->D + i] * m->dphi[k * m->d + c];
}

double imle_expert_leverage(struct imle *m, int j)
{
    const double *phibar = m->phibar + (size_t)j * (size_t)m->p;

    for (int k = 0; k < m->p; k++)
        m->gain[k] = m->phi[k] - phibar[k];
    triangle_solve(m->p, m->factor + (size_t)j * triangle_size(m->p), m->gain);
    return triangle_dot(m->p, m->gain, m->gain);
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
