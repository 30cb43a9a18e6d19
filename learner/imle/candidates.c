/* Experts to be, where births are by evidence. A candidate is an expert in every respect, but that
 * predictions do not know of it: so nothing of what it has learned is lost when it becomes one. It
 * lives in the last places, from the last one downwards, where it is copied from when it grows up.
 *
 * It becomes an expert when the newest n_outliers + 1 samples were all its own; or, where branches
 * take turns at random, when it has foretold twice as many, not too long ago. The first expert of
 * all needs two samples: nothing else could be believed. */
#include <math.h>

#include "learner/imle/evidence.h"

/* What is left of a candidate's score after a sample that is not its own. */
static const double score_left = 1.0 - 1.0 / 256.0;

/* A candidate goes when as many times the samples that it has had have come since its last: two
 * bursts of outliers are not to become one expert. */
static const double patience = 4.0;

/* A sample is foretold where the candidate was not wider than this many tolerances (of variance);
 * else it proves nothing that it agrees. */
static const double sure = 4.0;

/* A burst's expert has this many times the least samples at most, and goes when it was not needed
 * for so many samples. */
static const double burst = 3.0;
static const double needless_after = 1000.0;

int imle_candidate_place(const struct imle *m, int k)
{
    return m->config.capacity - 1 - k;
}

static struct imle_strengths *of_candidate(const struct imle *m, int k)
{
    return &m->state.strengths[imle_candidate_place(m, k)];
}

static void drop(struct imle *m, int k)
{
    int last = --m->state.candidates;

    if (k != last)
        imle_expert_copy(m, imle_candidate_place(m, last), imle_candidate_place(m, k));
}

void imle_candidates_wait(struct imle *m)
{
    for (int k = m->state.candidates - 1; k >= 0; k--) {
        struct imle_strengths *s = of_candidate(m, k);
        if (s->last >= m->state.samples)
            continue;
        s->row = 0.0;
        s->score *= score_left;
        if (m->state.samples - s->last > patience * s->H)
            drop(m, k);
    }
}

/* The place for one more: a free one, or that of the candidate that has shown least. -1: none. */
static int make_room(struct imle *m)
{
    int least = 0;

    int spare = imle_candidate_place(m, m->state.candidates) - m->state.M;
    if (m->state.candidates < IMLE_CANDIDATES && spare >= m->state.candidates)
        return m->state.candidates++;
    for (int k = 1; k < m->state.candidates; k++)
        if (of_candidate(m, k)->H < of_candidate(m, least)->H)
            least = k;
    return m->state.candidates > 0 ? least : -1;
}

/* The candidate that this sample is of, or a new one. -1: there is no place. */
static int candidate_for(struct imle *m, const double *z, const double *x)
{
    double least = INFINITY;
    int k = -1;

    for (int i = 0; i < m->state.candidates; i++) {
        int j = imle_candidate_place(m, i);
        double cost = imle_cost(m, j);
        if (!imle_explains(m, j) || cost >= least)
            continue;
        least = cost;
        k = i;
    }
    if (k >= 0)
        return k;
    k = make_room(m);
    if (k >= 0) {
        imle_densities(m);
        imle_expert_birth(m, imle_candidate_place(m, k), z, x, imle_parent_of_newborn(m));
    }
    return k;
}

/* How much would be lost with an expert: the samples that it has had, less the longer nothing was
 * its own. */
static double worth(const struct imle *m, int j)
{
    const struct imle_strengths *s = &m->state.strengths[j];

    return s->S * s->S / (s->S + m->state.samples - s->last);
}

/* A place among the experts for one that is worth so much; -1: none. One place is left for a
 * candidate, where there is more than one. */
static int place_among_experts(struct imle *m, double own)
{
    int least = -1;

    for (int j = 0; j < m->state.M; j++) {
        if (imle_vacant(m, j))
            return j;
        if (least < 0 || worth(m, j) < worth(m, least))
            least = j;
    }
    if (m->state.M < m->config.capacity - 1 || m->config.capacity == 1)
        return m->state.M++;
    return worth(m, least) < own ? least : -1;
}

static bool grown_up(const struct imle *m, const struct imle_strengths *s)
{
    double enough =
        (imle_experts(m) > 0 ? m->config.n_outliers : fmin(m->config.n_outliers, 1)) + 1.0;

    return s->row >= enough || s->score >= 2.0 * enough;
}

enum learner_update_result imle_nurse(struct imle *m, const double *z, const double *x)
{
    int k = candidate_for(m, z, x);

    if (k < 0)
        return LEARNER_FULL;
    int from = imle_candidate_place(m, k);
    struct imle_strengths *s = &m->state.strengths[from];
    bool foretold = s->S > 0.0 && 1.0 + imle_doubt(m, from) < sure;
    if (s->S > 0.0)
        imle_note_error(m, from);
    imle_expert_update(m, from, 1.0, z, x);
    s->row += 1.0;
    s->score += foretold;
    s->last = m->state.samples;
    imle_remember(m, from, z, x);
    if (!grown_up(m, s))
        return LEARNER_OUTLIER;
    int to = place_among_experts(m, worth(m, from));
    if (to < 0)
        return LEARNER_FULL;
    if (to != from)
        imle_expert_copy(m, from, to);
    drop(m, k);
    return LEARNER_BORN;
}

void imle_remove_needless(struct imle *m)
{
    double most = burst * (m->config.n_outliers + 1.0);

    for (int j = 0; j < m->state.M; j++) {
        const struct imle_strengths *s = &m->state.strengths[j];
        if (!imle_vacant(m, j) && s->H <= most && m->state.samples - s->last > needless_after) {
            imle_expert_remove(m, j);
            return;
        }
    }
}
