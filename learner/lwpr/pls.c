/* The regression of one receptive field: weighted partial least squares, one sample at a time
 * (table 3 of the paper). Inputs are projected on directions u_r one after the other, each that of
 * the greatest covariance with what the ones before have left of the output; after each, the part
 * of the input that it explains (the loading p_r) is taken away. */
#include <math.h>
#include <string.h>

#include "learner/lwpr/lwpr.h"

/* A sum under this is zero: forgetting must not grind it down to denormal numbers. */
static const double smallest_sum = 1e-150;

/* Share of the forgetting that a direction suffers: one that follows the samples of the last
 * moments turns with every passage through the field. */
static const double direction_memory = 0.1;

/* Share of the first projection's samples that the last one must have seen before the errors behind
 * them can be compared. */
static const double comparable = 0.99;

static double remember(double lambda, double sum, double addend)
{
    sum = lambda * sum + addend;
    return fabs(sum) < smallest_sum ? 0.0 : sum;
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;

    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/* z -= s p */
static void deflate(int d, double *z, double s, const double *p)
{
    for (int i = 0; i < d; i++)
        z[i] -= s * p[i];
}

void lwpr_pls_start(const struct lwpr *m, const struct lwpr_field *f, int r)
{
    size_t d = (size_t)m->d;

    f->stage[r] = (struct lwpr_stage){.lambda = m->p.init_lambda, .SS = m->p.init_s2};
    memset(f->covariance + (size_t)r * d, 0, d * sizeof(double));
    memset(f->SZ + (size_t)r * d, 0, d * sizeof(double));
    memset(f->direction + (size_t)r * d, 0, d * sizeof(double));
    memset(f->loading + (size_t)r * d, 0, d * sizeof(double));
}

/* Whether a projection has seen enough samples that its errors mean something. */
static bool has_matured(const struct lwpr *m, const struct lwpr_stage *stage)
{
    return stage->n > 2.0 * m->d;
}

int lwpr_pls_mature(const struct lwpr *m, const struct lwpr_field *f)
{
    int r = 0;

    while (r < (int)f->head->n_projections && has_matured(m, &f->stage[r]))
        r++;
    return r;
}

/* u_r of length 1; 0 while nothing covaries. */
static void refresh_direction(const struct lwpr *m, const struct lwpr_field *f, int r)
{
    const double *covariance = f->covariance + (size_t)r * (size_t)m->d;
    double *direction = f->direction + (size_t)r * (size_t)m->d;
    double length = sqrt(dot(m->d, covariance, covariance));
    double scale = length > 0.0 ? 1.0 / length : 0.0;

    for (int i = 0; i < m->d; i++)
        direction[i] = covariance[i] * scale;
}

static void refresh_slopes(const struct lwpr *m, const struct lwpr_field *f, int r)
{
    struct lwpr_stage *stage = &f->stage[r];
    const double *SZ = f->SZ + (size_t)r * (size_t)m->d;
    double *loading = f->loading + (size_t)r * (size_t)m->d;
    double per_SS = 1.0 / stage->SS;

    stage->beta = stage->SR * per_SS;
    for (int i = 0; i < m->d; i++)
        loading[i] = SZ[i] * per_SS;
}

void lwpr_pls_refresh(const struct lwpr *m, const struct lwpr_field *f)
{
    for (int r = 0; r < m->R; r++) {
        refresh_direction(m, f, r);
        refresh_slopes(m, f, r);
    }
}

static void learn_means(const struct lwpr *m, const struct lwpr_field *f, double y,
                        const struct lwpr_step *step)
{
    struct lwpr_stage *first = f->stage;
    double W = first->lambda * first->W + step->w;
    double gain = step->w / W;

    for (int i = 0; i < m->d; i++)
        f->mean[i] += gain * (step->v[i] - f->mean[i]);
    f->head->mean_y += gain * (y - f->head->mean_y);
}

/* Errors that the projections up to each r make at z before they learn it, into their E. Those of
 * the first samples, which the projection was made from, are left out. */
static void learn_errors(const struct lwpr *m, const struct lwpr_field *f, const double *input,
                         double residual, struct lwpr_step *step)
{
    double z[LEARNER_MAX_INPUTS];

    memcpy(z, input, (size_t)m->d * sizeof *z);
    step->e_cv = residual;
    for (int r = 0; r < (int)f->head->n_projections; r++) {
        struct lwpr_stage *stage = &f->stage[r];
        double s = dot(m->d, f->direction + (size_t)r * (size_t)m->d, z);
        deflate(m->d, z, s, f->loading + (size_t)r * (size_t)m->d);
        residual -= s * stage->beta;
        if (r < step->mature)
            step->e_cv = residual;
        if (!has_matured(m, stage))
            continue;
        stage->V = stage->lambda * stage->V + step->w;
        stage->E = remember(stage->lambda, stage->E, step->w * residual * residual);
    }
}

/* Projection r learns z and what is left of the output; both are then without its part. */
static double learn_projection(const struct lwpr *m, const struct lwpr_field *f, int r, double w,
                               double *z, double *residual)
{
    struct lwpr_stage *stage = &f->stage[r];
    double *covariance = f->covariance + (size_t)r * (size_t)m->d;
    double *SZ = f->SZ + (size_t)r * (size_t)m->d;
    double lambda = stage->lambda;
    double slow = 1.0 - direction_memory * (1.0 - lambda);

    for (int i = 0; i < m->d; i++)
        covariance[i] = remember(slow, covariance[i], w * z[i] * *residual);
    refresh_direction(m, f, r);
    double s = dot(m->d, f->direction + (size_t)r * (size_t)m->d, z);
    stage->W = lambda * stage->W + w;
    stage->n = lambda * stage->n + 1.0;
    stage->SS = fmax(remember(lambda, stage->SS, w * s * s), m->p.init_s2);
    stage->SR = remember(lambda, stage->SR, w * s * *residual);
    for (int i = 0; i < m->d; i++)
        SZ[i] = remember(lambda, SZ[i], w * s * z[i]);
    refresh_slopes(m, f, r);
    deflate(m->d, z, s, f->loading + (size_t)r * (size_t)m->d);
    *residual -= s * stage->beta;
    stage->lambda = m->p.tau_lambda * lambda + m->p.final_lambda * (1.0 - m->p.tau_lambda);
    return s;
}

/* One more when the last has taken away enough of the error of the one before. */
static void consider_projection(const struct lwpr *m, const struct lwpr_field *f)
{
    int n = (int)f->head->n_projections;
    const struct lwpr_stage *last = &f->stage[n - 1];
    const struct lwpr_stage *before = &f->stage[n - 2];

    if (n < 2 || n >= m->R || lwpr_pls_mature(m, f) < n || last->n < comparable * f->stage[0].n)
        return;
    if (last->E * before->V < m->p.add_threshold * before->E * last->V)
        f->head->n_projections = n + 1;
}

void lwpr_pls_learn(const struct lwpr *m, const struct lwpr_field *f, double y,
                    struct lwpr_step *step)
{
    double z[LEARNER_MAX_INPUTS] = {0};

    step->mature = lwpr_pls_mature(m, f);
    learn_means(m, f, y, step);
    for (int i = 0; i < m->d; i++)
        z[i] = step->v[i] - f->mean[i];
    double residual = y - f->head->mean_y;
    learn_errors(m, f, z, residual, step);
    double lambda = f->stage[0].lambda;
    step->leverage = 0.0;
    step->e = residual;
    for (int r = 0; r < (int)f->head->n_projections; r++) {
        step->s[r] = learn_projection(m, f, r, step->w, z, &residual);
        if (r >= step->mature)
            continue;
        step->e = residual;
        step->leverage += step->s[r] * step->s[r] / f->stage[r].SS;
    }
    f->head->dof = lambda * f->head->dof + step->w * step->w * step->leverage;
    consider_projection(m, f);
}

/* Projects z[d], which is overwritten; s[n] and the answer's part above the mean. */
static double project_input(const struct lwpr *m, const struct lwpr_field *f, int n, double *z,
                            double *s)
{
    double sum = 0.0;

    for (int r = 0; r < n; r++) {
        s[r] = dot(m->d, f->direction + (size_t)r * (size_t)m->d, z);
        deflate(m->d, z, s[r], f->loading + (size_t)r * (size_t)m->d);
        sum += s[r] * f->stage[r].beta;
    }
    return sum;
}

/* d yhat / d v: the projections' chain, last one first. With g the gradient by what projection r
 * leaves over, that by what it gets is g - u (p'g) + beta u. */
static void answer_gradient(const struct lwpr *m, const struct lwpr_field *f, int n, double *slope)
{
    memset(slope, 0, (size_t)m->d * sizeof *slope);
    for (int r = n - 1; r >= 0; r--) {
        const double *u = f->direction + (size_t)r * (size_t)m->d;
        double by_s = f->stage[r].beta - dot(m->d, f->loading + (size_t)r * (size_t)m->d, slope);
        for (int i = 0; i < m->d; i++)
            slope[i] += by_s * u[i];
    }
}

double lwpr_pls_answer(const struct lwpr *m, const struct lwpr_field *f, const double *v,
                       double *slope, double *variance)
{
    double z[LEARNER_MAX_INPUTS];
    double s[LEARNER_MAX_INPUTS];
    double leverage = 0.0;
    int n = lwpr_pls_mature(m, f);

    for (int i = 0; i < m->d; i++)
        z[i] = v[i] - f->mean[i];
    double y = f->head->mean_y + project_input(m, f, n, z, s);
    answer_gradient(m, f, n, slope);
    *variance = INFINITY;
    if (n == 0)
        return y;
    for (int r = 0; r < n; r++)
        leverage += s[r] * s[r] / f->stage[r].SS;
    double freedom = f->stage[n - 1].V - f->head->dof;
    if (freedom > 0.0)
        *variance = f->stage[n - 1].E / freedom * (1.0 + leverage);
    return y;
}
