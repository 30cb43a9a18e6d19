/* What experts are wrong by, where births are by evidence. Each keeps account of how far the
 * samples that it learned lay from what it foretold, where it claimed to know. From that follow how
 * far off a sample may be, and the variance that a solution states. */
#include <math.h>

#include "learner/imle/evidence.h"

/* The account is a mean over so many samples, at most; that of the typical error over fewer. */
static const double memory = 1000.0;
static const double newest = 300.0;

/* A tolerance is psi0 at first, as if so many samples had shown it, and less of them the more there
 * have been; then the mean square error, times `margin` where that is less than psi0. */
static const double assumed = 100.0;
static const double margin = 9.0;

/* Mean square of a Gaussian error, by the square of its mean size. */
static const double square_by_size = 1.5708;

/* Errors that follow each other are alike where an expert cannot express what it is to learn. They
 * tell of as many fewer errors, and so of larger ones elsewhere; up to this correlation. */
static const double most_alike = 0.8;

/* What an expert that has seen nothing may be wrong by, in units of sqrt(Psi_bar), at least: half
 * of the outputs' range, by the recipe for psi0 (docs/learner.md). */
static const double least_range = 25.0;

double imle_error(const struct imle_strengths *s)
{
    double prior = assumed * (1.0 - s->known / memory);

    return (prior + s->known * s->error) / (prior + s->known);
}

double imle_tolerance(const struct imle_strengths *s)
{
    double error = imle_error(s);

    return fmax(error, fmin(1.0, margin * error));
}

void imle_note_output(struct imle *m, const double *x)
{
    double *mean = m->state.seen;
    double *square = m->state.seen + m->D;

    for (int i = 0; i < m->D; i++) {
        double off = x[i] - mean[i];
        mean[i] += off / m->state.samples;
        square[i] += (off * (x[i] - mean[i]) - square[i]) / m->state.samples;
    }
}

/* gamma, but so that an expert that has seen nothing may be wrong by the range, or the spread of
 * all outputs where that is more: psi0 may be told too small. The samples' noise is `noise`, in
 * units of Psi_bar. */
static double doubt_of(const struct imle *m, double gamma, double noise)
{
    double spread = 0.0;

    for (int i = 0; i < m->D; i++)
        spread += m->state.seen[m->D + i] / (m->state.psi_bar[i] * m->D);
    double range = fmax(least_range * least_range, spread);
    return gamma * fmax(noise, range * m->config.ridge) / m->config.noise_share;
}

double imle_doubt(struct imle *m, int j)
{
    return doubt_of(m, imle_expert_gamma(m, j), m->config.noise_share);
}

void imle_note_error(struct imle *m, int j)
{
    struct imle_strengths *s = &m->state.strengths[j];
    double *residual = m->state.residual + (size_t)j * (size_t)m->D;
    double *typical = m->state.typical + (size_t)j * (size_t)m->D;
    double xhat[LEARNER_MAX_OUTPUTS];
    double square = 0.0;
    double again = 0.0;

    if (!(imle_doubt(m, j) < 1.0))
        return;
    s->known = fmin(s->known + 1.0, memory);
    imle_expert_output(m, j, xhat);
    for (int i = 0; i < m->D; i++) {
        double off = (m->query.target[i] - xhat[i]) / sqrt(m->state.psi_bar[i]);
        square += off * off / m->D;
        again += off * residual[i] / m->D;
        residual[i] = off;
        typical[i] += (fabs(off) - typical[i]) / fmin(0.5 * (s->known + 1.0), newest);
    }
    s->error += (square - s->error) / s->known;
    s->again += (again - s->again) / s->known;
}

void imle_stated_variances(const struct imle *m, int j, double gamma, double *variance)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    const double *typical = m->state.typical + (size_t)j * (size_t)m->D;
    double alike = fmax(0.0, fmin(most_alike, s->again / s->error));

    for (int i = 0; i < m->D; i++) {
        double own = square_by_size * typical[i] * typical[i];
        double doubt = doubt_of(m, gamma, fmin(m->config.noise_share, own));
        variance[i] = m->state.psi_bar[i] * (doubt + own * (1.0 + alike) / (1.0 - alike));
    }
}
