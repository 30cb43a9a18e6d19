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

    if (misfit > most && misfit > most * (1.0 + doubt_of(m, j)))
        return false;
    return m->D * elementary_log(1.0 + imle_expert_gamma(m, j)) <= most;
}

double imle_cost(struct imle *m, int j)
{
    double width = 1.0 + doubt_of(m, j);

    return m->D * elementary_log(width) + imle_expert_misfit(m, j) / width;
}

/* The same whatever the doubt, at least. */
static double least_cost(struct imle *m, double misfit)
{
    return misfit <= m->D ? misfit : m->D * (1.0 + elementary_log(misfit / m->D));
}

/* m->query.log_h of all experts: a bound above log h_j before normalising. Returns the expert with
 * the largest, or -1. */
static int bound_shares(struct imle *m)
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

/* log h_j itself in the place of its bound. */
static void sharpen(struct imle *m, int j)
{
    m->query.log_h[j] += 0.5 * (least_cost(m, imle_expert_misfit(m, j)) - imle_cost(m, j));
}

/* log h_j of all experts; where it cannot come near the largest, the bound, which does not either.
 * The best bound comes first, so that the others' doubts, which are dear, are seldom asked. Returns
 * the expert with the largest, or -1. */
static int weigh(struct imle *m)
{
    const double *log_h = m->query.log_h;
    int first = bound_shares(m);
    int best = first;

    if (first < 0)
        return -1;
    sharpen(m, first);
    for (int j = 0; j < m->state.M; j++) {
        if (j == first || imle_vacant(m, j) || log_h[j] < log_h[best] - too_far_behind)
            continue;
        sharpen(m, j);
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

enum learner_update_result imle_learn_by_evidence(struct imle *m, const double *z, const double *x)
{
    enum learner_update_result result = LEARNER_UPDATED;

    if (!imle_look_at_sample(m, z, x))
        return LEARNER_REFUSED;
    m->state.samples += 1.0;
    imle_note_output(m, x);
    int best = weigh(m);
    if (anybody_explains(m, best))
        learn_shares(m, best, z, x);
    else
        result = imle_nurse(m, z, x);
    imle_candidates_wait(m);
    imle_remove_needless(m);
    imle_remove_unneeded(m);
    imle_priors_update(m);
    return result;
}
