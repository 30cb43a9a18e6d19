/* Clusters by leaders: the most precise answers come first; each joins the nearest leader that it
 * does not contradict, or leads a cluster of its own. One pass, bounded by answers times solutions.
 */
#include <math.h>

#include "common/base/elementary.h"
#include "learner/imle/imle.h"

/* Index a comes before b: by key, then by age. */
static bool before(const struct imle *m, int a, int b)
{
    double key_a = m->log_h[a];
    double key_b = m->log_h[b];

    return key_a < key_b || (key_a <= key_b && a < b);
}

/* Heap sort of m->order[0 .. n): no memory, no worst case. */
static void sift_down(struct imle *m, int root, int n)
{
    for (int child = 2 * root + 1; child < n; child = 2 * root + 1) {
        if (child + 1 < n && before(m, m->order[child], m->order[child + 1]))
            child++;
        if (!before(m, m->order[root], m->order[child]))
            return;
        int swap = m->order[root];
        m->order[root] = m->order[child];
        m->order[child] = swap;
        root = child;
    }
}

void imle_sort_order(struct imle *m, int n)
{
    for (int root = n / 2 - 1; root >= 0; root--)
        sift_down(m, root, n);
    for (int end = n - 1; end > 0; end--) {
        int swap = m->order[0];
        m->order[0] = m->order[end];
        m->order[end] = swap;
        sift_down(m, 0, end);
    }
}

static void sort_by_precision(struct imle *m)
{
    for (int a = 0; a < m->n_answers; a++) {
        const struct imle_answer *answer = &m->answers[a];
        m->order[a] = a;
        m->log_h[a] =
            0.5 * m->D * elementary_log(answer->spread) + m->gate.half_log_psi[answer->expert];
    }
    imle_sort_order(m, m->n_answers);
}

/* sum (x_a - x_b)^2 / (R_a + R_b) */
static double contradiction(const struct imle *m, const struct imle_answer *a,
                            const struct imle_answer *b)
{
    const double *psi_a = m->psi + (size_t)a->expert * (size_t)m->D;
    const double *psi_b = m->psi + (size_t)b->expert * (size_t)m->D;
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
    for (int i = 0; i < m->n_answers; i++) {
        struct imle_answer *answer = &m->answers[m->order[i]];
        double smallest = INFINITY;
        for (int k = 0; k < n; k++) {
            double distance = contradiction(m, answer, &m->answers[leaders[k]]);
            if (distance < smallest) {
                smallest = distance;
                answer->cluster = k;
            }
        }
        if (smallest >= m->leader_threshold && n < m->config.n_solutions_max) {
            answer->cluster = n;
            leaders[n++] = m->order[i];
        }
    }
    return n;
}
