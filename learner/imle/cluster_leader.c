/* Clusters by leaders: the most precise answers come first; each joins the nearest leader that it
 * does not contradict, or leads a cluster of its own. One pass, bounded by answers times solutions.
 */
#include <math.h>

#include "common/base/elementary.h"
#include "learner/imle/imle.h"

static void sort_by_precision(struct imle *m)
{
    for (int a = 0; a < m->query.n_answers; a++) {
        const struct imle_answer *answer = &m->query.answers[a];
        m->query.order[a] = a;
        m->query.log_width[a] = 0.5 * m->D * elementary_log(answer->spread) +
                                m->derived.gate.half_log_psi[answer->expert];
    }
    imle_sort_by(m->query.log_width, m->query.order, m->query.n_answers);
}

/* sum (x_a - x_b)^2 / (R_a + R_b) */
static double contradiction(const struct imle *m, const struct imle_answer *a,
                            const struct imle_answer *b)
{
    const double *psi_a = m->state.psi + (size_t)a->expert * (size_t)m->D;
    const double *psi_b = m->state.psi + (size_t)b->expert * (size_t)m->D;
    double sum = 0.0;

    for (int i = 0; i < m->D; i++) {
        double difference = a->xhat[i] - b->xhat[i];
        sum += difference * difference / (psi_a[i] * a->spread + psi_b[i] * b->spread);
    }
    return sum;
}

int imle_cluster_by_leaders(struct imle *m)
{
    int leaders[LEARNER_MAX_SOLUTIONS];
    int n = 0;

    sort_by_precision(m);
    for (int i = 0; i < m->query.n_answers; i++) {
        struct imle_answer *answer = &m->query.answers[m->query.order[i]];
        double smallest = INFINITY;
        for (int k = 0; k < n; k++) {
            double distance = contradiction(m, answer, &m->query.answers[leaders[k]]);
            if (distance < smallest) {
                smallest = distance;
                answer->cluster = k;
            }
        }
        if (smallest >= m->leader_threshold && n < m->config.n_solutions_max) {
            answer->cluster = n;
            leaders[n++] = m->query.order[i];
        }
    }
    return n;
}
