/* One expert: its birth, and what one sample does to it (paper section 3, the M-step).
 *
 * For decay `delta` and responsibility h, with N the weight so far:
 *   mean    += h / (delta N + h) * (v - mean)
 *   scatter  = delta scatter + (delta N h / (delta N + h)) (v - mean)(v - mean)'
 * which is the scatter of the raw sums, without their cancellation. The regression follows by
 * recursive least squares on the same centred sample. */
#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/imle/evidence.h"

/* Weight and scatter that an expert has before its first sample. */
static const double birth_weight = 1e-6;
static const double birth_scatter = 1e-6;

/* Where a vacant place's centre is: its density underflows at any query. */
static const double out_of_reach = 1e30;

static double *at(double *array, int expert, size_t size)
{
    return array + (size_t)expert * size;
}

/* Entry (i, i) of a whitener. */
static double *diagonal(double *G, int i)
{
    return G + whitener_row(i) + (size_t)i;
}

/* Psi = (w_Psi Psi_bar + SSR) / (w_Psi + S_h + 2), or Psi_bar for a prior of infinite strength. */
static void refresh_psi(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    double *psi = at(m->state.psi, j, (size_t)m->D);
    const double *ssr = at(m->state.ssr, j, (size_t)m->D);

    if (m->by_evidence) {
        for (int i = 0; i < m->D; i++)
            psi[i] = m->state.psi_bar[i] * imle_tolerance(s);
        return;
    }
    for (int i = 0; i < m->D; i++)
        psi[i] = isinf(s->prior_psi)
                     ? m->state.psi_bar[i]
                     : (s->prior_psi * m->state.psi_bar[i] + ssr[i]) / (s->prior_psi + s->S + 2.0);
}

static void refresh_densities(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    double extra = m->config.prior_nu > 0.0 ? 2.0 : 1.0;
    double weight = s->prior_nu + s->S;
    double dof = s->prior_sigma + s->S - m->d + 1.0;
    double per_a = weight / ((weight + 1.0) * (s->prior_sigma + s->S + m->d + extra));
    const double *psi = at(m->state.psi, j, (size_t)m->D);
    double product = 1.0;

    for (int i = 0; i < m->D; i++)
        product *= psi[i];
    m->derived.gate.per_a[j] = per_a;
    m->derived.gate.exponent[j] = 0.5 * (dof + m->d);
    m->derived.gate.log_norm[j] = m->derived.gate.log_det[j] +
                                  elementary_log_gamma_ratio(0.5 * dof, 0.5 * m->d) +
                                  0.5 * m->d * elementary_log(2.0 * per_a);
    m->derived.gate.log_S[j] = elementary_log(s->S);
    m->derived.gate.half_log_psi[j] = 0.5 * elementary_log(product);
    m->derived.gate.log_peak[j] = m->derived.gate.log_det[j] - m->derived.gate.half_log_psi[j];
    m->derived.stale[j / IMLE_SUM] = true;
}

/* The root of Sigma^-1 is `scale` times the rows of G: its determinant, the diagonal of Sigma^-1,
 * and its place in the scan. */
static void refresh_root(struct imle *m, int j, double scale, const double *G)
{
    double *precision = at(m->derived.precision, j, (size_t)m->d);
    const double *row = G;

    imle_lanes_write(m, j, scale, G);
    m->derived.gate.log_det[j] = whitener_log_det(m->d, G) + m->d * elementary_log(scale);
    memset(precision, 0, (size_t)m->d * sizeof *precision);
    for (int r = 0; r < m->d; row += ++r)
        for (int c = 0; c <= r; c++)
            precision[c] += scale * scale * row[c] * row[c];
}

/* Sigma is its numerator / (w_Sigma + S_h + d + 1 (+ 1 if w_nu > 0)). */
void imle_expert_refresh(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    double extra = m->config.prior_nu > 0.0 ? 2.0 : 1.0;

    refresh_root(m, j, sqrt(s->prior_sigma + s->S + m->d + extra),
                 at(m->state.spread, j, whitener_row(m->d)));
    refresh_densities(m, j);
    imle_regression_write(m, j);
}

/* A newborn's own Sigma and Psi, with which it enters the E-step; as published, the divisors differ
 * by one from those of the M-step. */
static void first_densities(struct imle *m, int j)
{
    double *psi = at(m->state.psi, j, (size_t)m->D);
    double w = m->config.prior_sigma;
    double G[LEARNER_MAX_INPUTS * (LEARNER_MAX_INPUTS + 1) / 2];

    whitener_set_diagonal(m->d, G, 1.0);
    for (int i = 0; i < m->d; i++)
        *diagonal(G, i) = 1.0 / sqrt(w * m->state.sigma_bar[i]);
    for (int i = 0; i < m->D; i++)
        psi[i] = m->state.psi_bar[i] / (1.0 + 2.0 / m->config.prior_psi);
    refresh_root(m, j, sqrt(w + m->d + 2.0), G);
    refresh_densities(m, j);
    imle_regression_write(m, j);
    imle_forget_answers(m, j); /* its neighbours may have answered before it came */
}

static void first_regression(struct imle *m, int j, const double *x, int parent)
{
    size_t p = (size_t)m->p;
    size_t D = (size_t)m->D;
    double ridge = m->config.ridge + birth_scatter;
    double *W = at(m->state.W, j, p * D);

    memcpy(at(m->state.phibar, j, p), m->query.phi, p * sizeof(double));
    memcpy(at(m->state.xbar, j, D), x, D * sizeof(double));
    if (parent >= 0)
        memcpy(W, at(m->state.W, parent, p * D), p * D * sizeof(double));
    else
        memset(W, 0, p * D * sizeof(double));
    whitener_set_diagonal(m->p, at(m->state.whitener, j, whitener_row(m->p)), ridge);
    for (size_t k = 0; k < p; k++)
        at(m->state.ridge, j, p)[k] = ridge;
    memset(at(m->state.ssr, j, D), 0, D * sizeof(double));
    memset(at(m->state.residual, j, D), 0, D * sizeof(double));
    for (size_t i = 0; i < D; i++)
        at(m->state.typical, j, D)[i] = 1.0;
    size_t kept = IMLE_REMEMBERED * (size_t)(m->d + m->D);
    memset(at(m->state.remembered, j, kept), 0, kept * sizeof(double));
}

void imle_expert_birth(struct imle *m, int j, const double *z, const double *x, int parent)
{
    size_t d = (size_t)m->d;
    double *spread = at(m->state.spread, j, whitener_row(m->d));

    m->state.strengths[j] = (struct imle_strengths){
        .H = birth_weight,
        .prior_sigma = m->config.prior_sigma,
        .prior_nu = m->config.prior_nu,
        .prior_psi = m->config.prior_psi,
        .known = 1.0,
        .error = 1.0,
    };
    memcpy(at(m->state.nu, j, d), z, d * sizeof(double));
    memcpy(at(m->state.nu0, j, d), z, d * sizeof(double));
    memcpy(at(m->state.sigma_birth, j, d), m->state.sigma_bar, d * sizeof(double));
    whitener_set_diagonal(m->d, spread, 1.0);
    for (int i = 0; i < m->d; i++)
        *diagonal(spread, i) =
            1.0 / sqrt(m->config.prior_sigma * m->state.sigma_bar[i] + birth_scatter);
    first_regression(m, j, x, parent);
    first_densities(m, j);
}

bool imle_vacant(const struct imle *m, int j)
{
    return m->state.strengths[j].last < 0.0;
}

void imle_expert_copy(struct imle *m, int from, int to)
{
    struct imle_part source, target;

    m->state.strengths[to] = m->state.strengths[from];
    for (int k = 0; imle_state_part(m, from, k, &source); k++) {
        imle_state_part(m, to, k, &target);
        memcpy(target.begin, source.begin, source.size * sizeof(double));
    }
    imle_expert_refresh(m, to);
}

void imle_expert_remove(struct imle *m, int j)
{
    double *nu = at(m->state.nu, j, (size_t)m->d);

    m->state.strengths[j].last = -1.0;
    for (int i = 0; i < m->d; i++)
        nu[i] = out_of_reach;
    imle_expert_refresh(m, j);
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
    double *nu = at(m->state.nu, j, (size_t)m->d);
    double *G = at(m->state.spread, j, whitener_row(m->d));
    const double *row = G;
    double v[LEARNER_MAX_INPUTS];
    double y[LEARNER_MAX_INPUTS];

    for (int i = 0; i < m->d; i++) {
        v[i] = z[i] - nu[i];
        nu[i] += h / (weight + h) * v[i];
    }
    for (int r = 0; r < m->d; row += ++r) {
        y[r] = 0.0;
        for (int c = 0; c <= r; c++)
            y[r] += row[c] * v[c];
    }
    whitener_add(m->kernels, m->d, 0, G, delta, weight * h / (weight + h), y, &m->query.add);
}

/* What G whitens gets `more` at coordinate i of its diagonal. */
static void add_to_coordinate(struct imle *m, int n, double *G, int i, double more)
{
    for (int r = 0; r < n; r++)
        m->query.white[r] = r < i ? 0.0 : G[whitener_row(r) + (size_t)i];
    m->query.whitened = -1;
    whitener_add(m->kernels, n, i, G, 1.0, more, m->query.white, &m->query.add);
}

/* Forgetting takes the priors away with the rest: gives Sigma's back what it lacks to its floor. */
static void restore_prior_sigma(struct imle *m, int j)
{
    struct imle_strengths *s = &m->state.strengths[j];
    const double *sigma = at(m->state.sigma_birth, j, (size_t)m->d);
    double least = fmax(m->d, m->config.prior_floor * m->config.prior_sigma);

    if (s->prior_sigma >= least)
        return;
    for (int i = 0; i < m->d; i++)
        add_to_coordinate(m, m->d, at(m->state.spread, j, whitener_row(m->d)), i,
                          (least - s->prior_sigma) * sigma[i]);
    s->prior_sigma = least;
}

static void learn_gate(struct imle *m, int j, double h, double delta, const double *z)
{
    struct imle_strengths *s = &m->state.strengths[j];
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
                    at(m->state.nu0, j, (size_t)m->d));
        s->prior_nu = least_nu;
    }
}

/* Slopes and residuals: one step of recursive least squares; m->query.gain is C^-1 (phi - phibar).
 */
static void correct_slopes(struct imle *m, int j, double step, const double *residual)
{
    double *W = at(m->state.W, j, (size_t)m->p * (size_t)m->D);

    for (int i = 0; i < m->D; i++)
        m->kernels->add(m->p, step * residual[i], m->query.gain, W + (size_t)i * (size_t)m->p);
}

static void learn_regression(struct imle *m, int j, double h, double delta, const double *x)
{
    double *phibar = at(m->state.phibar, j, (size_t)m->p);
    double *xbar = at(m->state.xbar, j, (size_t)m->D);
    double *ssr = at(m->state.ssr, j, (size_t)m->D);
    double past = delta * m->state.strengths[j].S;
    double joint = past * h / (past + h);
    double xhat[LEARNER_MAX_OUTPUTS];
    double residual[LEARNER_MAX_OUTPUTS];

    imle_expert_output(m, j, xhat);
    imle_expert_whiten(m, j);
    double gamma = m->query.leverage;
    double left = 1.0 / (1.0 + joint / delta * gamma);
    for (int i = 0; i < m->D; i++) {
        residual[i] = x[i] - xhat[i];
        ssr[i] = delta * ssr[i] + joint * left * residual[i] * residual[i];
        xbar[i] += h / (past + h) * (x[i] - xbar[i]);
    }
    correct_slopes(m, j, joint / delta * left, residual);
    m->kernels->add(m->p, h / (past + h), m->query.offset, phibar);
    whitener_add(m->kernels, m->p, 0, at(m->state.whitener, j, whitener_row(m->p)), delta, joint,
                 m->query.white, &m->query.add);
    m->query.whitened = -1;
}

/* Forgetting would in time take the ridge out of C. One coordinate a sample, in turn, gets back
 * what it lacks to the floor: O(p^2), like the update itself. The slopes stay what they are. */
static void restore_ridge(struct imle *m, int j, double delta)
{
    struct imle_strengths *s = &m->state.strengths[j];
    double *ridge = at(m->state.ridge, j, (size_t)m->p);
    double least = m->config.prior_floor * m->config.ridge;
    int turn = (int)s->turn;

    for (int k = 0; k < m->p; k++)
        ridge[k] *= delta;
    if (ridge[turn] < least) {
        add_to_coordinate(m, m->p, at(m->state.whitener, j, whitener_row(m->p)), turn,
                          least - ridge[turn]);
        ridge[turn] = least;
    }
    s->turn = (turn + 1) % m->p;
}

void imle_expert_update(struct imle *m, int j, double h, const double *z, const double *x)
{
    double delta = decay(m->state.strengths[j].H, h, m->config.alpha);

    learn_regression(m, j, h, delta, x);
    restore_ridge(m, j, delta);
    learn_gate(m, j, h, delta, z);
    refresh_psi(m, j);
    imle_expert_refresh(m, j);
}
