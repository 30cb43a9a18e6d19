/* What experts are wrong by, where births are by evidence. Each keeps account of how far the
 * samples that it learned lay from what it foretold, where it claimed to know. From that follow how
 * far off a sample may be, the variance that a solution states, and when old samples are to fade.
 */
#include <math.h>

#include "learner/imle/evidence.h"
#include <stdio.h>
#include "learner/imle/lab.h"

/* The account is a mean over so many samples, at most; that of the typical error over fewer. */
static const double memory = 1000.0;
static const double newest = 300.0;

/* A tolerance is psi0 at first, as if so many samples had shown it, and less of them the more there
 * have been; then the mean square error, times `margin` where that is less than psi0. */
static const double assumed = 100.0;

/* Mean square of a vector of three errors, by the square of its mean size. */
static const double square_by_size = 1.571;


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
    double prior = assumed * (1.0 - s->known / memory);
    double error = (prior + s->known * s->error) / (prior + s->known);

    static double cap, mar;
    if (cap == 0) cap = lab("CAP", 1e9), mar = lab("MARGIN", 9);
    return fmin(cap, fmax(error, fmin(1.0, mar * error)));
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
 * all outputs where that is more: psi0 may be told too small. */
static double doubt_of(const struct imle *m, double gamma)
{
    double spread = 0.0;

    for (int i = 0; i < m->D; i++)
        spread += m->state.seen[m->D + i] / (m->state.psi_bar[i] * m->D);
    static double r; if (r == 0) r = lab("RANGE", 25), (void)least_range;
    double range = fmax(r * r, lab("SPREAD", 1) * spread);
    return gamma * fmax(1.0, range * m->config.ridge / m->config.noise_share);
}

double imle_doubt(struct imle *m, int j)
{
    return doubt_of(m, imle_expert_gamma(m, j));
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
    imle_expert_output(m, j, xhat);
    for (int i = 0; i < m->D; i++) {
        double off = (m->query.target[i] - xhat[i]) / sqrt(m->state.psi_bar[i]);
        square += off * off / m->D;
        again += off * residual[i] / m->D;
        residual[i] = off;
        typical[i] += (fabs(off) - typical[i]) / fmin(1.0 + s->known / lab("WIN", 1), newest);
    }
    s->known = fmin(s->known + 1.0, memory);
    s->error += (square - s->error) / s->known;
    if (s->known >= memory) {
        s->least = fmin(s->least, s->error);
        if (s->error > lab("GROW", 1e9) * s->least && s->fading <= 0.0) {
            s->least = s->error;
            s->fading = lab("OVER", 500);
            if (lab("SAY", 0) > 0) fprintf(stderr, "%g: %d fades, error %g, S %g\n", m->state.samples, j, s->error, s->S);
        }
    }
    s->again += (again - s->again) / s->known;
}

void imle_stated_variances(const struct imle *m, int j, double gamma, double *variance)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    const double *typical = m->state.typical + (size_t)j * (size_t)m->D;
    static double most; if (most==0) most = lab("ALIKE", 0.8);
    double alike = fmax(0.0, fmin(most, s->again / s->error));
    double doubt = doubt_of(m, gamma);

    for (int i = 0; i < m->D; i++)
        variance[i] = m->state.psi_bar[i] * (doubt + square_by_size * typical[i] * typical[i] *
                                                         (1.0 + alike) / (1.0 - alike));
}
