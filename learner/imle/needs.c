/* Which experts are still needed, where births are by evidence. While branches take turns before
 * any of them is known, experts learn a piece of one and a piece of another. Once the branches are
 * known as a whole, every sample of such an expert is explained at least as well by somebody else:
 * it has to go, or it would be a solution for ever.
 *
 * So each expert remembers a few of its samples, spread over all that it has learned. One after the
 * other is asked again: by how much would the best of the other experts explain it worse? An expert
 * goes when that is little for all of them together. What is known alone is needed, however long
 * nothing has been its own. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/imle/evidence.h"

/* One remembered sample is asked about in so many samples, where experts are large; it costs nearly
 * as much as to learn one. Else in each. */
static const double asked_every = 4.0;
static const int large = 100; /* features */

/* An expert is not needed where its samples would cost less than this more without it, in the mean
 * and as -2 log of a density. One sample counts as this much at most, for it may be an outlier. */
static const double little = 1.0;
static const double most = 4.0;

/* Fewer samples than this tell nothing. */
static const double enough = 3.0;

static double *remembered(const struct imle *m, int j, int k)
{
    return m->state.remembered + ((size_t)j * IMLE_REMEMBERED + (size_t)k) * (size_t)(m->d + m->D);
}

/* A number from 0 to 1 that looks like chance, and is always the same for the same sample. */
static double chance_of(double sample)
{
    uint64_t bits = (uint64_t)sample * 0x9E3779B97F4A7C15U;

    bits = (bits ^ (bits >> 29)) * 0xBF58476D1CE4E5B9U;
    return (double)((bits ^ (bits >> 32)) >> 11) * 0x1p-53;
}

void imle_remember(struct imle *m, int j, const double *z, const double *x)
{
    struct imle_strengths *s = &m->state.strengths[j];
    double place = s->remembers;

    if (place < IMLE_REMEMBERED)
        s->remembers += 1.0;
    else
        place = chance_of(m->state.samples) * fmax(s->H, IMLE_REMEMBERED);
    if (place >= IMLE_REMEMBERED)
        return;
    double *sample = remembered(m, j, (int)place);
    s->need[(int)place] = most;
    memcpy(sample, z, (size_t)m->d * sizeof *z);
    memcpy(sample + m->d, x, (size_t)m->D * sizeof *x);
}

/* -2 log of the density of the sample's output, with the errors that expert j is known to make. */
static double cost_by_errors(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    double width = imle_error(s) + imle_doubt(m, j);

    return m->D * elementary_log(width) + imle_expert_misfit(m, j) * imle_tolerance(s) / width;
}

/* By how much the sample would cost more without expert j. */
static double need_of(struct imle *m, int j)
{
    double own = cost_by_errors(m, j);
    double more = most;

    for (int k = 0; k < m->state.M; k++) {
        if (k == j || imle_vacant(m, k))
            continue;
        double square = imle_expert_misfit(m, k) * imle_tolerance(&m->state.strengths[k]) / m->D;
        if (square > 0.0 && m->D * (1.0 + elementary_log(square)) - own >= more)
            continue; /* whatever its errors */
        more = fmin(more, cost_by_errors(m, k) - own);
    }
    return fmax(-most, more);
}

static bool is_needed(const struct imle_strengths *s)
{
    double sum = 0.0;

    for (int k = 0; k < (int)s->remembers; k++)
        sum += s->need[k];
    return s->remembers < enough || sum > little * s->remembers;
}

/* Without that expert the others may be needed again. */
static void remove_and_ask_anew(struct imle *m, int j)
{
    imle_expert_remove(m, j);
    for (int i = 0; i < m->state.M; i++)
        for (int k = 0; k < IMLE_REMEMBERED; k++)
            m->state.strengths[i].need[k] = most;
}

void imle_remove_unneeded(struct imle *m)
{
    double turn = m->state.samples / (m->p < large ? 1.0 : asked_every);

    if (imle_experts(m) < 2 || turn > floor(turn))
        return;
    int j = (int)fmod(turn, m->state.M);
    struct imle_strengths *s = &m->state.strengths[j];
    if (imle_vacant(m, j) || s->remembers < 1.0)
        return;
    int k = (int)fmod(floor(turn / m->state.M), s->remembers);
    const double *z = remembered(m, j, k);
    if (!imle_look_at_sample(m, z, z + m->d))
        return;
    s->need[k] = need_of(m, j);
    if (!is_needed(s))
        remove_and_ask_anew(m, j);
}
