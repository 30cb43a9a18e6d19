/* One sample, where experts are born by evidence. Two things differ from the published rule
 * (learn.c):
 *
 * An expert is believed by as much as it can know. Where it has seen nothing it may be wrong by the
 * whole range of the outputs, so that a sample far from all that it has learned tells of no other
 * branch, and the expert learns it. In the E-step, too, an expert's answer is as wide as that: who
 * is sure and right comes before who cannot be wrong.
 *
 * What no expert explains goes to a candidate (candidates.c), which learns it, and becomes an
 * expert when it has foretold enough. */
#include <math.h>

#include "common/base/elementary.h"
#include "learner/imle/evidence.h"
#include "learner/imle/lab.h"
#include <stdio.h>
#include <string.h>

/* A sample is learned by the experts that have at least this share of it. A smaller one would be as
 * much as a whole to an expert that has seen nothing there. */
static const double least_share = 0.1;

/* An expert whose log h_j is this much under the largest has less than that share. */
static const double too_far_behind = 2.31;

/* What expert or candidate j may be wrong by because it has not seen enough, in units of its Psi.
 */
static double doubt_of(struct imle *m, int j)
{
    return imle_doubt(m, j) / imle_tolerance(&m->state.strengths[j]);
}

bool imle_explains(struct imle *m, int j)
{
    double most = -2.0 * m->log_c_joint;
    double misfit = imle_expert_misfit(m, j);

    static double pen; if (pen == 0) pen = lab("PEN", 1e9);
    if (misfit <= most && pen > 1e8) return true;
    double width = 1.0 + doubt_of(m, j);
    if (pen < 0) {
        double raw = 1.0 + imle_expert_gamma(m, j);
        return m->D * elementary_log(raw) + misfit / width <= most;
    }
    return misfit <= most * width && m->D * elementary_log(width) + misfit / width <= most + pen;
}

double imle_cost(struct imle *m, int j)
{
    static double share = -1; if (share < 0) share = lab("WIDE", 1);
    double width = 1.0 + share * doubt_of(m, j);

    return m->D * elementary_log(width) + imle_expert_misfit(m, j) / width;
}

/* The same whatever the doubt, at least. */
static double least_cost(struct imle *m, double misfit)
{
    return misfit <= m->D ? misfit : m->D * (1.0 + elementary_log(misfit / m->D));
}

/* m->query.log_h of all experts: at first a bound above it, log h_j before normalising were nobody in
 * doubt. Returns the expert with the largest bound, or -1. */
static int bound(struct imle *m)
{
    double *log_h = m->query.log_h;
    int best = -1;

    m->kernels->bounds(m->state.M, m->derived.gate.log_peak, -0.5, m->query.q, log_h);
    for (int j = 0; j < m->state.M; j++) {
        if (imle_vacant(m, j))
            continue;
        log_h[j] -= 0.5 * least_cost(m, imle_expert_misfit(m, j));
        if (best < 0 || log_h[j] > log_h[best])
            best = j;
    }
    return best;
}

/* Where the bound comes near the largest log h_j, that takes its place. It begins with the best
 * bound, so that the others are seldom asked. Returns the expert with the largest, or -1. */
static int weigh(struct imle *m)
{
    double *log_h = m->query.log_h;
    int first = bound(m);
    int best = first;

    for (int k = -1; best >= 0 && k < m->state.M; k++) {
        int j = k < 0 ? first : k;
        if ((k == first) || imle_vacant(m, j) || (k >= 0 && log_h[j] < log_h[best] - too_far_behind))
            continue;
        double misfit = imle_expert_misfit(m, j);
        log_h[j] += 0.5 * (least_cost(m, misfit) - imle_cost(m, j));
        if (log_h[j] > log_h[best])
            best = j;
    }
    return best;
}

static bool anybody_explains(struct imle *m, int best)
{
    if (best < 0 || imle_explains(m, best))
        return best >= 0;
    for (int j = 0; j < m->state.M; j++)
        if (!imle_vacant(m, j) && imle_explains(m, j))
            return true;
    return false;
}

static void learn_shares(struct imle *m, int best, const double *z, const double *x)
{
    double largest = m->query.log_h[best];
    double sum = 0.0;

    for (int j = 0; j < m->state.M; j++) {
        bool near = !imle_vacant(m, j) && m->query.log_h[j] >= largest - too_far_behind;
        m->query.h[j] = near ? elementary_exp(m->query.log_h[j] - largest) : 0.0;
        sum += m->query.h[j];
    }
    for (int j = 0; j < m->state.M; j++)
        if (m->query.h[j] >= least_share * sum) {
            imle_note_error(m, j);
            imle_expert_update(m, j, m->query.h[j] / sum, z, x);
        }
    m->state.strengths[best].last = m->state.samples;
    imle_remember(m, best, z, x);
}

static double *part(double *a, int j, size_t n) { return a + (size_t)j * n; }

static void weaken(struct imle *m, int j, double left)
{
    struct imle_strengths *s = &m->state.strengths[j];
    size_t D = (size_t)m->D;
    double grow = 1.0 / sqrt(left);
    s->S *= left; s->H *= left;
    double *G = part(m->state.whitener, j, whitener_row(m->p));
    for (size_t i = 0; i < whitener_row(m->p); i++) G[i] *= grow;
    G = part(m->state.spread, j, whitener_row(m->d));
    s->prior_sigma *= left;
    for (size_t i = 0; i < whitener_row(m->d); i++) G[i] *= grow;
    for (int i = 0; i < m->p; i++) part(m->state.ridge, j, (size_t)m->p)[i] *= left;
    s->known = 1.0; s->error = 1.0; s->again = 0.0;
    for (size_t i = 0; i < D; i++) part(m->state.typical, j, D)[i] = 1.0;
    for (size_t i = 0; i < D; i++) part(m->state.ssr, j, D)[i] *= left;
}

static bool split(struct imle *m, int j)
{
    struct imle_strengths *s = &m->state.strengths[j];
    const double *r = part(m->state.residual, j, (size_t)m->D);
    double sq = 0;
    for (int i = 0; i < m->D; i++) sq += r[i] * r[i] / m->D;
    if (s->known < lab("KNOWN", 30) || s->error < lab("SPLIT", 1e9) || s->again > 0.5 * s->error || sq < 0.5 * s->error || sq > 2 * s->error)
        return false;
    int to = imle_place_for_twin(m);
    if (to < 0) return false;
    double left = fmin(1.0, lab("LEFT", 20) / s->S);
    if (lab("SAY", 0) > 0) fprintf(stderr, "split %d -> %d at %g: error %g again %g S %g\n", j, to, m->state.samples, s->error, s->again, s->S);
    weaken(m, j, left);
    imle_expert_copy(m, j, to);
    for (int i = 0; i < m->D; i++) {
        double off = r[i] * sqrt(m->state.psi_bar[i]);
        part(m->state.xbar, j, (size_t)m->D)[i] += off;
        part(m->state.xbar, to, (size_t)m->D)[i] -= off;
    }
    imle_expert_refresh(m, j);
    imle_expert_refresh(m, to);
    return true;
}

enum learner_update_result imle_learn_by_evidence(struct imle *m, const double *z, const double *x)
{
    enum learner_update_result result = LEARNER_UPDATED;

    if (!imle_look_at_sample(m, z, x))
        return LEARNER_REFUSED;
    m->state.samples += 1.0;
    imle_note_output(m, x);
    int best = weigh(m);
    if (anybody_explains(m, best)) {
        learn_shares(m, best, z, x);
        split(m, best);
    }
    else
        result = imle_nurse(m, z, x);
    imle_candidates_wait(m);
    imle_remove_needless(m);
    static double dump; if (dump == 0) dump = lab("DUMP", -1);
    if (dump > 0 && fmod(m->state.samples, dump) == 0) {
        fprintf(stderr, "-- %g: candidates %d\n", m->state.samples, m->state.candidates);
        for (int j = 0; j < m->state.M; j++) {
            struct imle_strengths *t = &m->state.strengths[j];
            fprintf(stderr, "  %d S %.4g H %.4g last %.0f known %.0f error %.3g again %.2g row %g\n", j, t->S, t->H, t->last - m->state.samples, t->known, t->error, t->again / t->error, t->row);
        }
    }
    if (lab("NEEDS", 1) > 0) imle_ask_whether_needed(m);
    imle_priors_update(m);
    return result;
}
