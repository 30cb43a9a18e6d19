/* One expert: its birth, and what one sample does to it (paper section 3, the M-step).
 *
 * For decay `delta` and responsibility h, with N the weight so far:
 *   mean    += h / (delta N + h) * (v - mean)
 *   scatter  = delta scatter + (delta N h / (delta N + h)) (v - mean)(v - mean)'
 * which is the scatter of the raw sums, without their cancellation. The regression follows by
 * recursive least squares on the same centred sample. */
#include <math.h>
#include <string.h>

#include "daemon/elementary.h"
#include "daemon/imle_private.h"
#include "daemon/imle_triangle.h"

/* Weight and scatter that an expert has before its first sample. */
static const double birth_weight = 1e-6;
static const double birth_scatter = 1e-6;

static double *at(double *array, int expert, size_t size)
{
    return array + (size_t)expert * size;
}

/* Diagonal of a packed triangle: entry (i, i). */
static double *diagonal(double *triangle, int n, int i)
{
    return triangle + triangle_column(n, i);
}

/* Psi = (w_Psi Psi_bar + SSR) / (w_Psi + S_h + 2), or Psi_bar for a prior of infinite strength. */
static void refresh_psi(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->strengths[j];
    double *psi = at(m->psi, j, (size_t)m->D);
    const double *ssr = at(m->ssr, j, (size_t)m->D);

    for (int i = 0; i < m->D; i++)
        psi[i] = isinf(s->prior_psi)
                     ? m->psi_bar[i]
                     : (s->prior_psi * m->psi_bar[i] + ssr[i]) / (s->prior_psi + s->S + 2.0);
}

static void refresh_densities(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->strengths[j];
    struct imle_gate *gate = &m->gate[j];
    double extra = m->config.prior_nu > 0.0 ? 2.0 : 1.0;
    double weight = s->prior_nu + s->S;
    double dof = s->prior_sigma + s->S - m->d + 1.0;
    const double *psi = at(m->psi, j, (size_t)m->D);

    gate->a = (weight + 1.0) / weight * (s->prior_sigma + s->S + m->d + extra);
    gate->exponent = 0.5 * (dof + m->d);
    gate->log_norm = gate->log_det + elementary_log_gamma_ratio(0.5 * dof, 0.5 * m->d) +
                     0.5 * m->d * elementary_log(2.0 / gate->a);
    gate->log_S = elementary_log(s->S);
    gate->half_log_psi = 0.0;
    for (int i = 0; i < m->D; i++)
        gate->half_log_psi += 0.5 * elementary_log(psi[i]);
}

/* From G with Sigma^-1 = G' G: its determinant and the diagonal of the product. */
static void refresh_precision(struct imle *m, int j)
{
    const double *root = at(m->root, j, triangle_size(m->d));
    double *precision = at(m->precision, j, (size_t)m->d);

    m->gate[j].log_det = 0.0;
    for (int i = 0; i < m->d; i++) {
        const double *column = root + triangle_column(m->d, i);
        precision[i] = triangle_dot(m->d - i, column, column);
        m->gate[j].log_det += elementary_log(column[0]);
    }
}

/* Sigma = scatter / (w_Sigma + S_h + d + 1 (+ 1 if w_nu > 0)), and the scatter is F F'. */
static void refresh_root(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->strengths[j];
    size_t size = triangle_size(m->d);
    double *root = at(m->root, j, size);
    double extra = m->config.prior_nu > 0.0 ? 2.0 : 1.0;
    double scale = sqrt(s->prior_sigma + s->S + m->d + extra);

    memcpy(root, at(m->spread, j, size), size * sizeof *root);
    triangle_invert(m->d, root);
    for (size_t i = 0; i < size; i++)
        root[i] *= scale;
}

void imle_expert_refresh(struct imle *m, int j)
{
    refresh_root(m, j);
    refresh_precision(m, j);
    refresh_densities(m, j);
}

/* A newborn's own Sigma and Psi, with which it enters the E-step; as published, the divisors differ
 * by one from those of the M-step. */
static void first_densities(struct imle *m, int j)
{
    double *root = at(m->root, j, triangle_size(m->d));
    double *psi = at(m->psi, j, (size_t)m->D);
    double w = m->config.prior_sigma;

    triangle_set_diagonal(m->d, root, 0.0);
    for (int i = 0; i < m->d; i++)
        *diagonal(root, m->d, i) = sqrt((w + m->d + 2.0) / (w * m->sigma_bar[i]));
    for (int i = 0; i < m->D; i++)
        psi[i] = m->psi_bar[i] / (1.0 + 2.0 / m->config.prior_psi);
    refresh_precision(m, j);
    refresh_densities(m, j);
}

static void first_regression(struct imle *m, int j, const double *x, int parent)
{
    size_t p = (size_t)m->p;
    size_t D = (size_t)m->D;
    double ridge = m->config.ridge + birth_scatter;
    double *W = at(m->W, j, p * D);

    memcpy(at(m->phibar, j, p), m->phi, p * sizeof(double));
    memcpy(at(m->xbar, j, D), x, D * sizeof(double));
    if (parent >= 0)
        memcpy(W, at(m->W, parent, p * D), p * D * sizeof(double));
    else
        memset(W, 0, p * D * sizeof(double));
    triangle_set_diagonal(m->p, at(m->factor, j, triangle_size(m->p)), sqrt(ridge));
    for (size_t k = 0; k < p; k++)
        at(m->ridge, j, p)[k] = ridge;
    memset(at(m->ssr, j, D), 0, D * sizeof(double));
}

void imle_expert_birth(struct imle *m, const double *z, const double *x, int parent)
{
    int j = m->M++;
    size_t d = (size_t)m->d;
    double *spread = at(m->spread, j, triangle_size(m->d));

    m->strengths[j] = (struct imle_strengths){
        .H = birth_weight,
        .prior_sigma = m->config.prior_sigma,
        .prior_nu = m->config.prior_nu,
        .prior_psi = m->config.prior_psi,
    };
    memcpy(at(m->nu, j, d), z, d * sizeof(double));
    memcpy(at(m->nu0, j, d), z, d * sizeof(double));
    memcpy(at(m->sigma_birth, j, d), m->sigma_bar, d * sizeof(double));
    triangle_set_diagonal(m->d, spread, 0.0);
    for (int i = 0; i < m->d; i++)
        *diagonal(spread, m->d, i) = sqrt(m->config.prior_sigma * m->sigma_bar[i] + birth_scatter);
    first_regression(m, j, x, parent);
    first_densities(m, j);
}

/* The share of an expert's past that is left when it takes responsibility h. */
static double decay(double H, double h, double alpha)
{
    if (alpha >= 1.0)
        return 1.0;
    double shrink = elementary_exp(-alpha * elementary_log(H));
    return elementary_exp(alpha * elementary_log1p(h / H)) - h * shrink;
}

/* The gating's scatter becomes delta times itself, plus that of a point of weight h; `weight` is
 * what the mean has so far. */
static void add_to_gate(struct imle *m, int j, double delta, double weight, double h,
                        const double *z)
{
    double *nu = at(m->nu, j, (size_t)m->d);
    double joint = sqrt(weight * h / (weight + h));
    double v[LEARNER_MAX_INPUTS];

    for (int i = 0; i < m->d; i++) {
        v[i] = joint * (z[i] - nu[i]);
        nu[i] += h / (weight + h) * (z[i] - nu[i]);
    }
    triangle_update(m->d, at(m->spread, j, triangle_size(m->d)), delta, v);
}

/* Forgetting takes the priors away with the rest: gives Sigma's back what it lacks to its floor. */
static void restore_prior_sigma(struct imle *m, int j)
{
    struct imle_strengths *s = &m->strengths[j];
    const double *sigma = at(m->sigma_birth, j, (size_t)m->d);
    double least = fmax(m->d, m->config.prior_floor * m->config.prior_sigma);
    double v[LEARNER_MAX_INPUTS] = {0.0};

    if (s->prior_sigma >= least)
        return;
    for (int i = 0; i < m->d; i++) {
        v[i] = sqrt((least - s->prior_sigma) * sigma[i]);
        triangle_update(m->d, at(m->spread, j, triangle_size(m->d)), 1.0, v);
        memset(v, 0, sizeof v);
    }
    s->prior_sigma = least;
}

static void learn_gate(struct imle *m, int j, double h, double delta, const double *z)
{
    struct imle_strengths *s = &m->strengths[j];
    double least_nu = m->config.prior_floor * m->config.prior_nu;

    s->prior_sigma *= delta;
    s->prior_nu *= delta;
    s->prior_psi = fmax(delta * s->prior_psi, m->config.prior_floor * m->config.prior_psi);
    add_to_gate(m, j, delta, s->prior_nu + delta * s->S, h, z);
    s->H += h;
    s->S = delta * s->S + h;
    restore_prior_sigma(m, j);
    if (s->prior_nu < least_nu) {
        add_to_gate(m, j, 1.0, s->prior_nu + s->S, least_nu - s->prior_nu,
                    at(m->nu0, j, (size_t)m->d));
        s->prior_nu = least_nu;
    }
}

/* Slopes and residuals: one step of recursive least squares; m->gain is C^-1 (phi - phibar). */
static void correct_slopes(struct imle *m, int j, double step, const double *residual)
{
    double *W = at(m->W, j, (size_t)m->p * (size_t)m->D);

    for (int k = 0; k < m->p; k++)
        for (int i = 0; i < m->D; i++)
            W[k * m->D + i] += step * m->gain[k] * residual[i];
}

static void learn_regression(struct imle *m, int j, double h, double delta, const double *x)
{
    double *factor = at(m->factor, j, triangle_size(m->p));
    double *phibar = at(m->phibar, j, (size_t)m->p);
    double *xbar = at(m->xbar, j, (size_t)m->D);
    double *ssr = at(m->ssr, j, (size_t)m->D);
    double past = delta * m->strengths[j].S;
    double joint = past * h / (past + h);
    double xhat[LEARNER_MAX_OUTPUTS];
    double residual[LEARNER_MAX_OUTPUTS];

    imle_expert_output(m, j, xhat);
    double gamma = imle_expert_leverage(m, j);
    triangle_solve_transposed(m->p, factor, m->gain);
    double left = 1.0 / (1.0 + joint / delta * gamma);
    for (int i = 0; i < m->D; i++) {
        residual[i] = x[i] - xhat[i];
        ssr[i] = delta * ssr[i] + joint * left * residual[i] * residual[i];
        xbar[i] += h / (past + h) * (x[i] - xbar[i]);
    }
    correct_slopes(m, j, joint / delta * left, residual);
    for (int k = 0; k < m->p; k++) {
        m->offset[k] = sqrt(joint) * (m->phi[k] - phibar[k]);
        phibar[k] += h / (past + h) * (m->phi[k] - phibar[k]);
    }
    triangle_update(m->p, factor, delta, m->offset);
}

/* Forgetting would in time take the ridge out of C. One coordinate a sample, in turn, gets back
 * what it lacks to the floor: O(p^2), like the update itself. The slopes stay what they are. */
static void restore_ridge(struct imle *m, int j, double delta)
{
    struct imle_strengths *s = &m->strengths[j];
    double *ridge = at(m->ridge, j, (size_t)m->p);
    double least = m->config.prior_floor * m->config.ridge;
    int turn = (int)s->turn;

    for (int k = 0; k < m->p; k++)
        ridge[k] *= delta;
    if (ridge[turn] < least) {
        memset(m->offset, 0, (size_t)m->p * sizeof *m->offset);
        m->offset[turn] = sqrt(least - ridge[turn]);
        triangle_update(m->p, at(m->factor, j, triangle_size(m->p)), 1.0, m->offset);
        ridge[turn] = least;
    }
    s->turn = (turn + 1) % m->p;
}

void imle_expert_update(struct imle *m, int j, double h, const double *z, const double *x)
{
    double delta = decay(m->strengths[j].H, h, m->config.alpha);

    learn_regression(m, j, h, delta, x);
    restore_ridge(m, j, delta);
    learn_gate(m, j, h, delta, z);
    refresh_psi(m, j);
    imle_expert_refresh(m, j);
}
