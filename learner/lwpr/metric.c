/* A receptive field's distance metric D = M'M: what it makes of a vector, and how it is learned, by
 * stochastic gradient descent on the leave-one-out error of the field's regression plus a penalty
 * on large D (table 4 of the paper). */
#include <math.h>
#include <string.h>

#include "learner/lwpr/lwpr.h"

/* A step that would change a number on M's diagonal by more than this share of it is not taken, and
 * the rates halved. */
static const double largest_change = 0.07;

/* 1 - h of a sample, h the leverage, counts as at least this where the memory terms divide by it: a
 * sample that makes its own fit would otherwise outweigh all others for thousands of samples. */
static const double least_rest = 0.5;

/* M v, for M upper triangular by rows. */
static void root_times(int d, const double *root, const double *v, double *Mv)
{
    for (int i = 0; i < d; i++) {
        double sum = 0.0;
        for (int k = i; k < d; k++)
            sum += *root++ * v[k];
        Mv[i] = sum;
    }
}

double lwpr_distance(const struct lwpr *m, const struct lwpr_field *f, const double *v)
{
    double Mv[LEARNER_MAX_INPUTS];
    double q = 0.0;

    if (m->p.diagonal_only)
        for (int i = 0; i < m->d; i++)
            Mv[i] = f->root[i] * v[i];
    else
        root_times(m->d, f->root, v, Mv);
    for (int i = 0; i < m->d; i++)
        q += Mv[i] * Mv[i];
    return q;
}

void lwpr_metric_times(const struct lwpr *m, const struct lwpr_field *f, const double *v,
                       double *Dv)
{
    const double *root = f->root;
    double Mv[LEARNER_MAX_INPUTS];

    if (m->p.diagonal_only) {
        for (int i = 0; i < m->d; i++)
            Dv[i] = root[i] * root[i] * v[i];
        return;
    }
    root_times(m->d, root, v, Mv);
    memset(Dv, 0, (size_t)m->d * sizeof *Dv);
    for (int i = 0; i < m->d; i++)
        for (int k = i; k < m->d; k++)
            Dv[k] += *root++ * Mv[i];
}

int lwpr_next_diagonal(const struct lwpr *m, int diagonal, int row)
{
    return diagonal + (m->p.diagonal_only ? 1 : m->d - row);
}

/* dJ1/dw: how the leave-one-out error changes with the sample's weight. The sample's own error
 * counts more, it normalises, and it moves the regression, which all samples remembered in H and G
 * are judged by. */
static double cost_by_weight(const struct lwpr_field *f, const struct lwpr_step *step)
{
    const struct lwpr_stage *last = &f->stage[step->mature - 1];
    double by_slopes = 0.0;
    double by_leverage = 0.0;

    for (int r = 0; r < step->mature; r++) {
        double q = step->s[r] / f->stage[r].SS;
        by_slopes += q * f->stage[r].H;
        by_leverage += q * q * f->stage[r].G;
    }
    double cost = step->e_cv * step->e_cv - 2.0 * step->e * by_slopes - 2.0 * by_leverage;
    return (cost - last->E / last->V) / f->stage[0].W;
}

/* J2 = penalty / d sum D_ij^2. By M that is 4 penalty / d M D, of which the numbers that M has. */
static void penalty_gradient(const struct lwpr *m, const struct lwpr_field *f, double *gradient)
{
    double factor = 4.0 * m->p.penalty / m->d;
    double unit[LEARNER_MAX_INPUTS] = {0};
    double column[LEARNER_MAX_INPUTS];

    if (m->p.diagonal_only) {
        for (int i = 0; i < m->d; i++)
            gradient[i] = factor * f->root[i] * f->root[i] * f->root[i];
        return;
    }
    for (int l = 0; l < m->d; l++) {
        unit[l] = 1.0;
        lwpr_metric_times(m, f, unit, column);
        unit[l] = 0.0;
        for (int k = 0, row = 0; k <= l; row = lwpr_next_diagonal(m, row, k++)) {
            double sum = 0.0;
            for (int i = k; i < m->d; i++)
                sum += f->root[row + i - k] * column[i];
            gradient[row + l - k] = factor * sum;
        }
    }
}

/* dw/dM_kl = -w (M v)_k v_l, times `factor`, onto the gradient. */
static void add_weight_gradient(const struct lwpr *m, const struct lwpr_field *f,
                                const struct lwpr_step *step, double factor, double *gradient)
{
    const double *v = step->v;

    factor *= -step->w;
    for (int k = 0, row = 0; k < m->d; row = lwpr_next_diagonal(m, row, k++)) {
        int end = m->p.diagonal_only ? k + 1 : m->d;
        double Mv = 0.0;
        for (int l = k; l < end; l++)
            Mv += f->root[row + l - k] * v[l];
        for (int l = k; l < end; l++)
            gradient[row + l - k] += factor * Mv * v[l];
    }
}

void lwpr_metric_gradient(const struct lwpr *m, const struct lwpr_field *f,
                          const struct lwpr_step *step, double *gradient)
{
    double share = step->w / f->stage[0].W;

    penalty_gradient(m, f, gradient);
    for (int i = 0; i < m->n_root; i++)
        gradient[i] *= share;
    add_weight_gradient(m, f, step, cost_by_weight(f, step), gradient);
}

/* How far one sample's gradient is to be believed: its error before and after it was learned are
 * alike once the regression has settled, and far apart while the sample makes its own fit. */
static double trust_in_sample(const struct lwpr_step *step)
{
    double before = step->e_cv * step->e_cv;
    double ratio = before > 0.0 ? fmin(step->e * step->e / before, 1.0) : 0.0;

    return ratio * ratio * ratio * ratio;
}

static bool too_far(const struct lwpr *m, const struct lwpr_field *f, double scale,
                    const double *gradient)
{
    for (int row = 0, i = 0; row < m->d; i = lwpr_next_diagonal(m, i, row++))
        if (!(fabs(scale * f->rate[i] * gradient[i]) <= largest_change * f->root[i]))
            return true;
    return false;
}

static void descend_gradient(const struct lwpr *m, const struct lwpr_field *f, double scale,
                             const double *gradient)
{
    bool refused = too_far(m, f, scale, gradient);

    for (int i = 0; i < m->n_root; i++) {
        if (refused)
            f->rate[i] *= 0.5;
        else
            f->root[i] =
                fmax(fmin(f->root[i] - scale * f->rate[i] * gradient[i], LWPR_LARGEST_ROOT),
                     -LWPR_LARGEST_ROOT);
    }
    for (int row = 0, i = 0; row < m->d; i = lwpr_next_diagonal(m, i, row++))
        f->root[i] = fmax(f->root[i], LWPR_SMALLEST_ROOT);
}

static void remember_sample(const struct lwpr_field *f, double scale, const struct lwpr_step *step)
{
    double rest = fmax(1.0 - step->w * step->leverage, least_rest);
    double H = scale * step->w * step->e_cv / rest;
    double G = scale * step->w * step->w * step->e_cv * step->e_cv / rest;

    for (int r = 0; r < step->mature; r++) {
        struct lwpr_stage *stage = &f->stage[r];
        stage->H = stage->lambda * stage->H + H * step->s[r];
        stage->G = stage->lambda * stage->G + G * step->s[r] * step->s[r];
    }
}

void lwpr_metric_learn(const struct lwpr *m, const struct lwpr_field *f,
                       const struct lwpr_step *step)
{
    double gradient[LEARNER_MAX_INPUTS * (LEARNER_MAX_INPUTS + 1) / 2];
    double scale = trust_in_sample(step);

    if (step->mature == 0)
        return;
    lwpr_metric_gradient(m, f, step, gradient);
    descend_gradient(m, f, scale, gradient);
    remember_sample(f, scale, step);
}
