/* All values of the map at a query: every expert's answer, gathered into clusters, each cluster
 * averaged into one solution (paper section 3, multi-valued prediction). */
#include <math.h>

#include "common/base/elementary.h"
#include "learner/imle/imle.h"

/* An expert that lags this far behind the best, its t below exp(-this) of the largest, is left out:
 * all of them together move a solution by less than M exp(-this) of what they differ from it, 2e-6
 * for 1000 experts. */
static const double negligible_lag = 20.0;

/* p_out(z) in units of the largest t is cut here: beyond it a solution has no weight anyway. */
static const double farthest = 1e100;

/* Gating and features of the query; false when there is nothing to predict from. */
static bool look_at_query(struct imle *m, const double *z)
{
    if (imle_experts(m) == 0)
        return false;
    imle_new_query(m, NULL);
    feature_map_evaluate(m->map, z, m->query.phi);
    for (int k = 0; k < m->p; k++)
        if (!(fabs(m->query.phi[k]) <= LEARNER_LARGEST_FEATURE))
            return false;
    feature_map_derivative(m->map, z, m->query.phi, m->query.dphi);
    imle_scan_distances(m, z);
    imle_densities(m);
    return true;
}

/* Of the kernel's two results the other, log_t once more, is not wanted. */
static double largest_log_t(struct imle *m)
{
    const double *log_t = m->query.log_t;

    return m->kernels->bounds(m->state.M, log_t, 0.0, log_t, m->query.lag);
}

/* m->query.order lists the experts with m->query.lag not over `limit`, in the order of age. Returns
 * how many, which may be more than fit: those beyond `room` are only counted. */
static int list_experts(struct imle *m, double limit, int room)
{
    int n = 0;

    for (int j = 0; j < m->state.M; j++) {
        if (n < room)
            m->query.order[n] = j;
        n += m->query.lag[j] <= limit;
    }
    return n;
}

/* The experts to ask: those with m->query.lag from 0 up to `limit`; where these are more than
 * IMLE_MOST_ANSWERS, up to the largest limit (to 1/4096 of the whole) that leaves few enough. */
static int choose_experts(struct imle *m, double limit)
{
    double low = 0.0;
    double high = limit;
    int n = list_experts(m, limit, IMLE_MOST_ANSWERS);

    if (n <= IMLE_MOST_ANSWERS)
        return n;
    for (int halvings = 0; halvings < 12; halvings++) {
        double middle = 0.5 * (low + high);
        if (list_experts(m, middle, 0) > IMLE_MOST_ANSWERS)
            high = middle;
        else
            low = middle;
    }
    n = list_experts(m, low, IMLE_MOST_ANSWERS);
    return n < IMLE_MOST_ANSWERS ? n : IMLE_MOST_ANSWERS;
}

static void add_answer(struct imle *m, int j)
{
    struct imle_answer *answer = &m->query.answers[m->query.n_answers++];

    answer->expert = j;
    answer->cluster = 0;
    answer->log_t = m->query.log_t[j];
    answer->t = elementary_exp(m->query.log_t[j] - m->query.largest_log_t);
    answer->gamma = imle_expert_gamma(m, j);
    imle_expert_output(m, j, answer->xhat);
    answer->sloped = false;
    if (!m->small)
        imle_gamma_slope(m, answer);
}

/* Answers of the first n in m->query.order, and the sum of their t. */
static void ask_experts(struct imle *m, int n, double log_outlier)
{
    m->query.n_answers = 0;
    m->query.all_t = fmin(elementary_exp(log_outlier - m->query.largest_log_t), farthest);
    for (int k = 0; k < n; k++) {
        add_answer(m, m->query.order[k]);
        m->query.all_t += m->query.answers[k].t;
    }
}

/* Answers with the published variance R_j = Psi_j (gamma_j + W / t_j). */
static void gather_published_answers(struct imle *m, double log_outlier)
{
    for (int j = 0; j < m->state.M; j++)
        m->query.lag[j] = m->query.largest_log_t - m->query.log_t[j];
    ask_experts(m, choose_experts(m, negligible_lag), log_outlier);
    for (int k = 0; k < m->query.n_answers; k++)
        m->query.answers[k].spread =
            m->query.answers[k].gamma + m->query.all_t / m->query.answers[k].t;
}

/* Answers with R_j = Psi_j (1 + gamma_j) / (tau_j / max tau)^kappa, tau_j being t_j without its
 * determinant, so that narrow experts do not outshout wide ones. Whoever has too large an R could
 * only ever follow another: left out. */
static void gather_answers_by_distance(struct imle *m, double log_outlier)
{
    double kappa = m->config.kappa;

    double nearest = m->kernels->bounds(m->state.M, m->query.log_t, -1.0, m->derived.gate.log_norm,
                                        m->query.lag);
    for (int j = 0; j < m->state.M; j++)
        m->query.lag[j] = kappa * (nearest - m->query.lag[j]);
    ask_experts(m, choose_experts(m, negligible_lag), log_outlier);
    for (int k = 0; k < m->query.n_answers; k++) {
        struct imle_answer *answer = &m->query.answers[k];
        answer->spread = (1.0 + answer->gamma) * elementary_exp(m->query.lag[answer->expert]);
    }
}

static int cluster_answers(struct imle *m, double log_outlier)
{
    if (m->config.clustering == LEARNER_CLUSTER_PUBLISHED)
        gather_published_answers(m, log_outlier);
    else
        gather_answers_by_distance(m, log_outlier);
    if (m->config.clustering == LEARNER_CLUSTER_LEADER)
        return imle_cluster_by_leaders(m);
    return imle_cluster_by_splitting(m);
}

/* Strongest first; of equals the one whose principal expert is older. */
static void sort_solutions(struct learner_solution *solution, int n)
{
    for (int i = 0; i < n; i++) {
        int best = i;
        for (int k = i + 1; k < n; k++)
            if (solution[k].weight > solution[best].weight ||
                (solution[k].weight >= solution[best].weight &&
                 solution[k].principal < solution[best].principal))
                best = k;
        struct learner_solution swap = solution[i];
        solution[i] = solution[best];
        solution[best] = swap;
    }
}

int imle_predict(struct imle *m, const double *z, struct learner_prediction *prediction)
{
    if (!look_at_query(m, z))
        return 0;
    double log_outlier = imle_log_outlier_input(m);
    m->query.largest_log_t = largest_log_t(m);
    int n = cluster_answers(m, log_outlier);
    for (int k = 0; k < n; k++)
        imle_fuse(m, z, k, log_outlier, &prediction->solution[k]);
    sort_solutions(prediction->solution, n);
    return n;
}

int imle_predict_single(struct imle *m, const double *z, struct learner_solution *solution)
{
    if (!look_at_query(m, z))
        return 0;
    double log_outlier = imle_log_outlier_input(m);
    m->query.largest_log_t = largest_log_t(m);
    gather_published_answers(m, log_outlier);
    imle_fuse(m, z, 0, log_outlier, solution);
    return 1;
}
