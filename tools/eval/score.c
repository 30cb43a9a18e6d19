#include "tools/eval/score.h"

#include <math.h>
#include <stdlib.h>

struct errors {
    size_t n;
    double squares[LEARNER_MAX_OUTPUTS];
};

static void add_error(struct errors *errors, int n_outputs, const double *value,
                      const double *truth)
{
    errors->n++;
    for (int i = 0; i < n_outputs; i++)
        errors->squares[i] += (value[i] - truth[i]) * (value[i] - truth[i]);
}

static struct score_rmse rmse_of(const struct errors *errors, int n_outputs)
{
    struct score_rmse rmse = {.n = errors->n, .mean = NAN};
    double sum = 0;

    for (int i = 0; i < n_outputs; i++) {
        rmse.component[i] = errors->n > 0 ? sqrt(errors->squares[i] / (double)errors->n) : NAN;
        sum += rmse.component[i];
    }
    rmse.mean = sum / n_outputs;
    return rmse;
}

static double squared_distance(int n, const double *a, const double *b)
{
    double sum = 0;

    for (int i = 0; i < n; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/* Of at least one solution; the stronger of two that are equally near. */
static const struct learner_solution *nearest(const struct learner_prediction *prediction,
                                              int n_outputs, const double *x)
{
    const struct learner_solution *best = &prediction->solution[0];
    double least = squared_distance(n_outputs, best->value, x);

    for (int k = 1; k < prediction->n_solutions; k++) {
        const struct learner_solution *solution = &prediction->solution[k];
        double distance = squared_distance(n_outputs, solution->value, x);
        if (distance < least) {
            least = distance;
            best = solution;
        }
    }
    return best;
}

/* Relative errors of Jacobians; all that a table may have. */
struct ratios {
    size_t n;
    double *value;
};

static struct ratios make_ratios(const struct csv_table *table)
{
    struct ratios ratios = {0};

    if (table->has_jacobian)
        ratios.value = calloc(table->n_rows, sizeof *ratios.value);
    return ratios;
}

static void add_ratio(struct ratios *ratios, const struct csv_table *table, size_t row,
                      const struct learner_solution *solution)
{
    int n = table->n_inputs * table->n_outputs;
    double size = 0;

    if (!ratios->value)
        return;
    const double *truth = csv_jacobian(table, row);
    for (int i = 0; i < n; i++)
        size += truth[i] * truth[i];
    if (size > 0)
        ratios->value[ratios->n++] = sqrt(squared_distance(n, solution->jacobian, truth) / size);
}

static int compare(const void *a, const void *b)
{
    double left = *(const double *)a;
    double right = *(const double *)b;

    return (left > right) - (left < right);
}

/* Frees the ratios. */
static struct score_jacobian summarise_ratios(struct ratios *ratios)
{
    struct score_jacobian jacobian = {.n = ratios->n, .median = NAN, .mean = NAN};
    size_t n = ratios->n;
    double sum = 0;

    if (n > 0) {
        qsort(ratios->value, n, sizeof *ratios->value, compare);
        jacobian.median = 0.5 * (ratios->value[(n - 1) / 2] + ratios->value[n / 2]);
        for (size_t i = 0; i < n; i++)
            sum += ratios->value[i];
        jacobian.mean = sum / (double)n;
    }
    free(ratios->value);
    return jacobian;
}

static int timed_predict(struct learner *learner, const double *z,
                         struct learner_prediction *prediction, struct durations *durations)
{
    int64_t start = durations_clock();
    int n = learner_predict(learner, z, prediction);

    durations_add(durations, start);
    return n;
}

struct score_test score_test(struct learner *learner, const struct csv_table *table,
                             struct durations *durations)
{
    static struct learner_prediction prediction; /* too large for some stacks */
    struct score_test score = {.n_rows = table->n_rows};
    struct errors closest = {0};
    struct errors strongest = {0};
    struct errors single = {0};
    struct ratios ratios = make_ratios(table);
    struct learner_solution average;
    size_t n_solutions = 0;
    int D = table->n_outputs;

    for (size_t row = 0; row < table->n_rows; row++) {
        const double *z = csv_input(table, row);
        const double *x = csv_output(table, row);
        int n = timed_predict(learner, z, &prediction, durations);
        score.n_with[n]++;
        n_solutions += (size_t)n;
        if (learner_predict_single(learner, z, &average))
            add_error(&single, D, average.value, x);
        if (n == 0) {
            score.n_unanswered++;
            continue;
        }
        const struct learner_solution *best = nearest(&prediction, D, x);
        add_error(&closest, D, best->value, x);
        add_error(&strongest, D, prediction.solution[0].value, x);
        add_ratio(&ratios, table, row, best);
    }
    score.closest = rmse_of(&closest, D);
    score.strongest = rmse_of(&strongest, D);
    score.single = rmse_of(&single, D);
    score.mean_solutions = (double)n_solutions / (double)table->n_rows;
    score.jacobian = summarise_ratios(&ratios);
    return score;
}

struct score_track score_track(struct learner *learner, const struct csv_table *table,
                               struct durations *durations)
{
    static struct learner_prediction prediction;
    struct score_track score = {.n_rows = table->n_rows - 1};
    struct errors followed = {0};
    struct errors closest = {0};
    struct ratios ratios = make_ratios(table);
    size_t n_solutions = 0;
    int D = table->n_outputs;

    for (size_t row = 1; row < table->n_rows; row++) {
        const double *x = csv_output(table, row);
        int n = timed_predict(learner, csv_input(table, row), &prediction, durations);
        n_solutions += (size_t)n;
        if (n == 0) {
            score.n_unanswered++;
            continue;
        }
        const struct learner_solution *chosen = nearest(&prediction, D, csv_output(table, row - 1));
        const struct learner_solution *best = nearest(&prediction, D, x);
        add_error(&followed, D, chosen->value, x);
        add_error(&closest, D, best->value, x);
        add_ratio(&ratios, table, row, chosen);
        score.n_wrong += chosen != best;
    }
    score.followed = rmse_of(&followed, D);
    score.closest = rmse_of(&closest, D);
    score.wrong_branch = (double)score.n_wrong / (double)score.n_rows;
    score.mean_solutions = (double)n_solutions / (double)score.n_rows;
    score.jacobian = summarise_ratios(&ratios);
    return score;
}
