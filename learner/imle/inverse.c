/* Inputs that give a wanted output. Each expert seeks the z that is most probable under its own
 * p(z) p(x | z): Gauss-Newton from its centre,
 *   A step = Sigma^-1 (nu - z) + Lambda' Psi^-1 (x - xhat(z)),  A = Sigma^-1 + Lambda' Psi^-1
 * Lambda with Lambda the slope at z. For an expert linear in z one step is the published formula;
 * for the others steps are damped until they help. The answers are gathered by leaders, strongest
 * first; a solution is its leader's own answer, for the mean of two answers on a curved surface
 * lies off it. */
#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/imle/chi2.h"
#include "learner/imle/imle.h"
#include "learner/imle/triangle.h"

enum { MOST_STEPS = 20, PACKED = LEARNER_MAX_INPUTS * (LEARNER_MAX_INPUTS + 1) / 2 };

/* An answer whose log weight is this much under the strongest one's is not given. */
static const double negligible_under_strongest = 40.0;

/* The search of one expert. */
struct search {
    int expert;
    double z[LEARNER_MAX_INPUTS];
    double cost; /* q + sum (x - xhat)^2 / Psi */
    double downhill[LEARNER_MAX_INPUTS];
    double A[PACKED];
    double residual[LEARNER_MAX_OUTPUTS];
};

static const double *part(const double *array, int expert, size_t size)
{
    return array + (size_t)expert * size;
}

/* What the expert says at s->z; its features stay in m->query.phi. */
static void evaluate_at(struct imle *m, struct search *s, const double *x)
{
    const double *psi = part(m->state.psi, s->expert, (size_t)m->D);
    double xhat[LEARNER_MAX_OUTPUTS];

    feature_map_evaluate(m->map, s->z, m->query.phi);
    imle_new_query(m, NULL);
    imle_expert_output(m, s->expert, xhat);
    s->cost = imle_gate_pull(m, s->expert, s->z, s->downhill);
    for (int i = 0; i < m->D; i++) {
        s->residual[i] = x[i] - xhat[i];
        s->cost += s->residual[i] * s->residual[i] / psi[i];
    }
}

/* Sigma^-1 as a packed triangle in A, and Sigma^-1 (nu - z) in downhill. */
static void begin_with_gate(const struct imle *m, struct search *s)
{
    (void)imle_gate_pull(m, s->expert, s->z, s->downhill);
    for (int i = 0; i < m->d; i++)
        s->downhill[i] = -s->downhill[i];
    imle_gate_precision(m, s->expert, s->A);
}

/* A and downhill at s->z. */
static void linearise_at(struct imle *m, struct search *s)
{
    const double *psi = part(m->state.psi, s->expert, (size_t)m->D);

    begin_with_gate(m, s);
    feature_map_derivative(m->map, s->z, m->query.phi, m->query.dphi);
    imle_expert_slope(m, s->expert);
    for (int o = 0; o < m->D; o++) {
        const double *slope = m->query.slope + o * m->d;
        for (int i = 0; i < m->d; i++) {
            s->downhill[i] += slope[i] / psi[o] * s->residual[o];
            for (int k = i; k < m->d; k++)
                s->A[triangle_column(m->d, i) + (size_t)(k - i)] += slope[i] / psi[o] * slope[k];
        }
    }
}

/* A (1 + damping on the diagonal) step = downhill; false when A is not positive definite. */
static bool solve_step(const struct imle *m, const struct search *s, double damping, double *step)
{
    double L[PACKED];

    memcpy(L, s->A, triangle_size(m->d) * sizeof *L);
    for (int i = 0; i < m->d; i++)
        L[triangle_column(m->d, i)] *= 1.0 + damping;
    if (triangle_factor(m->d, L) != 0)
        return false;
    memcpy(step, s->downhill, (size_t)m->d * sizeof *step);
    triangle_solve(m->d, L, step);
    triangle_solve_transposed(m->d, L, step);
    return true;
}

/* Walks from the expert's centre to its best z, and leaves A there. */
static void seek_input(struct imle *m, struct search *s, const double *x)
{
    bool linear = m->config.features == LEARNER_LINEAR;
    double damping = linear ? 0.0 : 1e-3;
    double step[LEARNER_MAX_INPUTS];

    memcpy(s->z, part(m->state.nu, s->expert, (size_t)m->d), (size_t)m->d * sizeof(double));
    evaluate_at(m, s, x);
    linearise_at(m, s);
    for (int n = 0; n < (linear ? 1 : MOST_STEPS); n++) {
        struct search next = *s;
        if (!solve_step(m, s, damping, step))
            return;
        for (int i = 0; i < m->d; i++)
            next.z[i] += step[i];
        evaluate_at(m, &next, x);
        double gain = s->cost - next.cost;
        damping *= gain > 0.0 ? 0.2 : 10.0;
        if (gain > 0.0 || linear) {
            linearise_at(m, &next);
            *s = next;
        }
        if (fabs(gain) < 1e-12 * (1.0 + s->cost))
            return;
    }
}

/* log N(x; expert's mean, Psi + Lambda Sigma Lambda'), by Laplace's method at the best z: exact for
 * an expert linear in z. */
static double log_weight(const struct imle *m, const struct search *s)
{
    double L[PACKED];
    double log_det = 0.0;

    memcpy(L, s->A, triangle_size(m->d) * sizeof *L);
    if (triangle_factor(m->d, L) != 0)
        return -INFINITY;
    for (int i = 0; i < m->d; i++)
        log_det += elementary_log(L[triangle_column(m->d, i)]);
    return m->derived.gate.log_det[s->expert] - log_det - m->derived.gate.half_log_psi[s->expert] -
           0.5 * s->cost;
}

/* Packed A^-1. */
static void covariance(const struct imle *m, const struct search *s, double *C)
{
    double L[PACKED];

    memcpy(L, s->A, triangle_size(m->d) * sizeof *L);
    if (triangle_factor(m->d, L) != 0)
        triangle_set_diagonal(m->d, L, 1.0);
    triangle_invert(m->d, L);
    for (int i = 0; i < m->d; i++)
        for (int k = i; k < m->d; k++)
            C[triangle_column(m->d, i) + (size_t)(k - i)] =
                triangle_dot(m->d - k, L + triangle_column(m->d, i) + (size_t)(k - i),
                             L + triangle_column(m->d, k));
}

/* difference' (C_a + C_b)^-1 difference */
static double contradiction(const struct imle *m, const double *z_a, const double *C_a,
                            const double *z_b, const double *C_b)
{
    double L[PACKED];
    double y[LEARNER_MAX_INPUTS];

    for (size_t i = 0; i < triangle_size(m->d); i++)
        L[i] = C_a[i] + C_b[i];
    if (triangle_factor(m->d, L) != 0)
        return 0.0;
    for (int i = 0; i < m->d; i++)
        y[i] = z_a[i] - z_b[i];
    triangle_solve(m->d, L, y);
    return triangle_dot(m->d, y, y);
}

/* Appends the answer unless an earlier one already says the same. */
static void add_unless_known(const struct imle *m, const struct search *s, double weight,
                             double threshold, double (*C)[PACKED], struct learner_inverse *inverse)
{
    int n = inverse->n_solutions;
    struct learner_inverse_solution *solution = &inverse->solution[n];

    covariance(m, s, C[n]);
    for (int k = 0; k < n; k++)
        if (contradiction(m, s->z, C[n], inverse->solution[k].z, C[k]) < threshold)
            return;
    memset(solution, 0, sizeof *solution);
    memcpy(solution->z, s->z, (size_t)m->d * sizeof(double));
    for (int i = 0; i < m->d; i++)
        solution->variance[i] = C[n][triangle_column(m->d, i)];
    solution->weight = weight;
    solution->principal = s->expert;
    inverse->n_solutions++;
}

int imle_predict_inverse(struct imle *m, const double *x, struct learner_inverse *inverse)
{
    double threshold = chi2_quantile(m->d, m->config.leader_level);
    double C[LEARNER_MAX_SOLUTIONS][PACKED];

    for (int j = 0; j < m->state.M; j++) {
        m->query.cost[j] = INFINITY;
        if (imle_vacant(m, j))
            continue;
        struct search s = {.expert = j};
        seek_input(m, &s, x);
        m->query.order[j] = j;
        m->query.cost[j] = -log_weight(m, &s);
    }
    imle_sort_by(m->query.cost, m->query.order, m->state.M);
    for (int k = 0; k < m->state.M && inverse->n_solutions < m->config.n_solutions_max; k++) {
        struct search s = {.expert = m->query.order[k]};
        double below = m->query.cost[m->query.order[k]] - m->query.cost[m->query.order[0]];
        if (!(below < negligible_under_strongest))
            break;
        seek_input(m, &s, x);
        add_unless_known(m, &s, elementary_exp(-below), threshold, C, inverse);
    }
    return inverse->n_solutions;
}
