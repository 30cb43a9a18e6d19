#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/imle/evidence.h"
#include "learner/imle/lab.h"
#include <stdint.h>

static double *slot(struct imle *m, int j, int k)
{
    return m->state.remembered + ((size_t)j * IMLE_REMEMBERED + (size_t)k) * (size_t)(m->d + m->D);
}

void imle_remember(struct imle *m, int j, const double *z, const double *x)
{
    struct imle_strengths *s = &m->state.strengths[j];
    int k = (int)s->remembers;

    if (k >= IMLE_REMEMBERED) {
        uint64_t bits = (uint64_t)m->state.samples * 0x9E3779B97F4A7C15u;
        bits ^= bits >> 29; bits *= 0xBF58476D1CE4E5B9u; bits ^= bits >> 32;
        double chance = (double)(bits >> 11) * 0x1p-53 * fmax(s->H, IMLE_REMEMBERED);
        if (!(chance < IMLE_REMEMBERED)) return;
        k = (int)chance;
    } else
        s->remembers += 1.0;
    s->need[k] = 4.0;
    memcpy(slot(m, j, k), z, (size_t)m->d * sizeof *z);
    memcpy(slot(m, j, k) + m->d, x, (size_t)m->D * sizeof *x);
}

static double honest_cost(struct imle *m, int j)
{
    const struct imle_strengths *s = &m->state.strengths[j];
    double width = imle_error(s) + imle_doubt(m, j);
    return m->D * elementary_log(width) + imle_expert_misfit(m, j) * imle_tolerance(s) / width;
}

static double need(struct imle *m, int j)
{
    double own = honest_cost(m, j);
    double other = INFINITY;
    for (int k = 0; k < m->state.M; k++) {
        if (k == j || imle_vacant(m, k)) continue;
        double sq = fmax(1e-9, imle_expert_misfit(m, k) * imle_tolerance(&m->state.strengths[k]));
        if (m->D * (1.0 + elementary_log(sq / m->D)) > own + 4.0) continue;
        other = fmin(other, honest_cost(m, k));
    }
    return fmax(-4.0, fmin(4.0, other - own));
}

void imle_ask_whether_needed(struct imle *m)
{
    static double every, most; if (every == 0) every = lab("EVERY", 4), most = lab("NEED", 1);
    int M = m->state.M;
    if (imle_experts(m) < 2 || fmod(m->state.samples, every) != 0) return;
    int j = (int)fmod(m->state.samples / every, M);
    struct imle_strengths *s = &m->state.strengths[j];
    if (imle_vacant(m, j) || s->remembers < 3) return;
    int k = (int)fmod(floor(m->state.samples / every / M), s->remembers);
    const double *z = slot(m, j, k);
    if (!imle_look_at_sample(m, z, z + m->d)) return;
    s->need[k] = need(m, j);
    double sum = 0;
    for (int i = 0; i < s->remembers; i++) sum += s->need[i];
    if (sum > most * s->remembers) return;
    if (lab("SAY", 0) > 0) fprintf(stderr, "%g: not needed %d: sum %g, S %g error %g\n", m->state.samples, j, sum, s->S, s->error);
    imle_expert_remove(m, j);
    for (int i = 0; i < M; i++)
        for (int n = 0; n < IMLE_REMEMBERED; n++) m->state.strengths[i].need[n] = 4.0;
}
