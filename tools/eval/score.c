#include "tools/eval/score.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tools/measure/quantiles.h"

/* Errors of one kind of answer, all that a table may have. */
struct errors {
    size_t n;
    double squares[LEARNER_MAX_OUTPUTS];
    double *distance;
};

static double *room_for(size_t n)
{
    double *numbers = calloc(n, sizeof *numbers);

    if (!numbers) {
        fprintf(stderr, "reach-eval: out of memory for the errors of %zu rows\n", n);
        exit(EXIT_FAILURE);
    }
    return numbers;
}

static struct errors make_errors(const struct csv_table *table)
{
    return (struct errors){.distance = room_for(table->n_rows)};
}

static void add_error(struct errors *errors, int n_outputs, const double *value,
                      const double *truth)
{
    double sum = 0;

    for (int i = 0; i < n_outputs; i++) {
        double square = (value[i] - truth[i]) * (value[i] - truth[i]);
        errors->squares[i] += square;
        sum += square;
    }
    errors->distance[errors->n++] = sqrt(sum);
}

/* Frees the errors. */
static struct score_error summarise_errors(struct errors *errors, int n_outputs)
{
    struct score_error error = {.n = errors->n, .mean = NAN};
    double sum = 0;

    for (int i = 0; i < n_outputs; i++) {
        error.rmse[i] = errors->n > 0 ? sqrt(errors->squares[i] / (double)errors->n) : NAN;
        sum += error.rmse[i];
    }
    error.mean = sum / n_outputs;
    quantiles_sort(errors->distance, errors->n);
    error.median = quantile(errors->distance, errors->n, 0.5);
    error.p95 = quantile(errors->distance, errors->n, 0.95);
    free(errors->distance);
    return error;
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
        ratios.value = room_for(table->n_rows);
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

/* Frees the ratios. */
static struct score_jacobian summarise_ratios(struct ratios *ratios)
{
    struct score_jacobian jacobian = {.n = ratios->n, .median = NAN, .mean = NAN};
    size_t n = ratios->n;
    double sum = 0;

    if (n > 0) {
        quantiles_sort(ratios->value, n);
        jacobian.median = 0.5 * (ratios->value[(n - 1) / 2] + ratios->value[n / 2]);
        for (size_t i = 0; i < n; i++)
            sum += ratios->value[i];
        jacobian.mean = sum / (double)n;
    }
    free(ratios->value);
    return jacobian;
}

/* Errors in units of what was stated of them; all that a table may have. */
struct shares {
    size_t n;
    double *value;
};

static void add_shares(struct shares *shares, int n_outputs,
                       const struct learner_solution *solution, const double *truth)
{
    for (int i = 0; i < n_outputs; i++) {
        double deviation = sqrt(solution->variance[i]);
        if (deviation > 0 && isfinite(deviation))
            shares->value[shares->n++] = fabs(solution->value[i] - truth[i]) / deviation;
    }
}

/* Frees the shares. */
static struct score_calibration summarise_shares(struct shares *shares)
{
    struct score_calibration calibration = {.n = shares->n};

    quantiles_sort(shares->value, shares->n);
    calibration.median = quantile(shares->value, shares->n, 0.5);
    calibration.p95 = quantile(shares->value, shares->n, 0.95);
    free(shares->value);
    return calibration;
}

/* What tests and tracks gather alike. */
struct gathered {
    const struct csv_table *table;
    struct errors closest, strongest;
    struct shares shares;
    struct ratios ratios;
    size_t n_solutions, n_unanswered;
};

static struct gathered begin(const struct csv_table *table)
{
    return (struct gathered){
        .table = table,
        .closest = make_errors(table),
        .strongest = make_errors(table),
        .shares.value = room_for(table->n_rows * (size_t)table->n_outputs),
        .ratios = make_ratios(table),
    };
}

static void predict(const struct score_desk *desk, const double *z, struct gathered *gathered,
                    struct learner_prediction *prediction)
{
    int64_t start = durations_clock();
    int n = learner_predict(desk->learner, z, prediction);

    durations_add(desk->durations, start);
    health_count_solutions(desk->health, n);
    gathered->n_solutions += (size_t)n;
    gathered->n_unanswered += n == 0;
}

/* Takes the answers to one row, of which there is one at least. Returns the closest. */
static const struct learner_solution *gather(struct gathered *gathered, const double *x,
                                             const struct learner_prediction *prediction)
{
    const int D = gathered->table->n_outputs;
    const struct learner_solution *closest = nearest(prediction, D, x);

    add_error(&gathered->closest, D, closest->value, x);
    add_error(&gathered->strongest, D, prediction->solution[0].value, x);
    add_shares(&gathered->shares, D, closest, x);
    return closest;
}

struct score_test score_test(const struct score_desk *desk, const char *name,
                             const struct csv_table *table)
{
    static struct learner_prediction prediction; /* too large for some stacks */
    struct score_test score = {.n_rows = table->n_rows};
    struct gathered gathered = begin(table);
    struct errors single = make_errors(table);
    struct learner_solution average;
    const int D = table->n_outputs;

    for (size_t row = 0; row < table->n_rows; row++) {
        const double *z = csv_input(table, row);
        const double *x = csv_output(table, row);
        struct rows_entry entry = {.set = name, .row = row, .truth = x};
        predict(desk, z, &gathered, &prediction);
        score.n_with[prediction.n_solutions]++;
        if (learner_predict_single(desk->learner, z, &average)) {
            add_error(&single, D, average.value, x);
            entry.single = &average;
        }
        if (prediction.n_solutions > 0) {
            entry.closest = gather(&gathered, x, &prediction);
            add_ratio(&gathered.ratios, table, row, entry.closest);
        }
        rows_add(desk->rows, &entry, &prediction);
    }
    score.n_unanswered = gathered.n_unanswered;
    score.closest = summarise_errors(&gathered.closest, D);
    score.strongest = summarise_errors(&gathered.strongest, D);
    score.single = summarise_errors(&single, D);
    score.calibration = summarise_shares(&gathered.shares);
    score.mean_solutions = (double)gathered.n_solutions / (double)table->n_rows;
    score.jacobian = summarise_ratios(&gathered.ratios);
    return score;
}

struct score_track score_track(const struct score_desk *desk, const char *name,
                               const struct csv_table *table)
{
    static struct learner_prediction prediction;
    struct score_track score = {.n_rows = table->n_rows - 1};
    struct gathered gathered = begin(table);
    struct errors followed = make_errors(table);
    const int D = table->n_outputs;

    for (size_t row = 1; row < table->n_rows; row++) {
        const double *x = csv_output(table, row);
        struct rows_entry entry = {.set = name, .row = row, .truth = x};
        predict(desk, csv_input(table, row), &gathered, &prediction);
        if (prediction.n_solutions > 0) {
            entry.closest = gather(&gathered, x, &prediction);
            entry.followed = nearest(&prediction, D, csv_output(table, row - 1));
            add_error(&followed, D, entry.followed->value, x);
            add_ratio(&gathered.ratios, table, row, entry.followed);
            score.n_wrong += entry.followed != entry.closest;
        }
        rows_add(desk->rows, &entry, &prediction);
    }
    score.n_unanswered = gathered.n_unanswered;
    score.followed = summarise_errors(&followed, D);
    score.closest = summarise_errors(&gathered.closest, D);
    score.strongest = summarise_errors(&gathered.strongest, D);
    score.calibration = summarise_shares(&gathered.shares);
    score.wrong_branch = (double)score.n_wrong / (double)score.n_rows;
    score.mean_solutions = (double)gathered.n_solutions / (double)score.n_rows;
    score.jacobian = summarise_ratios(&gathered.ratios);
    return score;
}
