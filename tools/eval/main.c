/* reach-eval: teaches a learner from files and measures it, away from any robot. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "common/base/arena.h"
#include "learner/finder/seeker.h"
#include "tools/eval/csv.h"
#include "tools/eval/model_file.h"
#include "tools/eval/report.h"
#include "tools/eval/request.h"
#include "tools/eval/rows.h"
#include "tools/eval/warnings.h"
#include "tools/measure/learner_options.h"
#include "tools/measure/output_file.h"

/* All that a run holds. */
struct run {
    struct request request;
    struct learner_config config;
    struct arena *arena;
    struct learner *learner;
    struct seeker seeker; /* of the body, with experts: body */
    struct csv_table *train, *sets;
    struct health health;
    const char *input_names[LEARNER_MAX_INPUTS];
    struct warnings warnings;
    struct rows rows;
    int file;   /* of the sample that is learned next */
    size_t row; /* in that file */
    struct durations updates;
    struct durations predictions;
    time_t last_progress;
    struct report report;
    char error[1024];
};

static int fail(struct run *run, const char *what, const char *reason)
{
    snprintf(run->error, sizeof run->error, "%s: %s", what, reason);
    return -1;
}

static int read_config(struct run *run)
{
    struct request *request = &run->request;
    const char *shipped =
        learner_options_shipped(request->kind, request->n_inputs, request->n_outputs);

    if (request->n_files == 0 && shipped) {
        request->files[request->n_files++] = shipped;
        warnings_add(&run->warnings,
                     "no --config: %s was taken by default for %d inputs and %d outputs, joints "
                     "in rad; does it fit?",
                     strrchr(shipped, '/') + 1, request->n_inputs, request->n_outputs);
    }
    return learner_options_load(&(struct learner_sources){request->kind, request->n_inputs,
                                                          request->n_outputs, request->files,
                                                          request->n_files, request->params,
                                                          request->n_params},
                                &run->config, run->error, sizeof run->error);
}

static int read_table(struct run *run, const char *path, struct csv_table *table)
{
    return csv_read(path, run->request.n_inputs, run->request.n_outputs, table, run->error,
                    sizeof run->error);
}

static int read_tables(struct run *run)
{
    struct request *request = &run->request;
    char reason[120];
    size_t rows = 0;

    run->train = calloc((size_t)request->n_train + 1, sizeof *run->train);
    run->sets = calloc((size_t)request->n_sets + 1, sizeof *run->sets);
    if (!run->train || !run->sets)
        return fail(run, "the files", "out of memory");
    for (int i = 0; i < request->n_train; i++) {
        if (read_table(run, request->train[i], &run->train[i]))
            return -1;
        rows += run->train[i].n_rows;
    }
    for (int i = 0; i < request->n_sets; i++) {
        if (read_table(run, request->sets[i].path, &run->sets[i]))
            return -1;
        if (request->sets[i].is_track && run->sets[i].n_rows < 2)
            return fail(run, request->sets[i].path, "a track needs two rows");
    }
    if (request->n_at == 0)
        request->at[request->n_at++] = rows;
    if (request->at[request->n_at - 1] <= rows)
        return 0;
    snprintf(reason, sizeof reason, "--at %zu is beyond the %zu training samples",
             request->at[request->n_at - 1], rows);
    return fail(run, request->n_train > 0 ? request->train[request->n_train - 1] : "--train",
                reason);
}

static int check_outputs(struct run *run)
{
    const struct request *request = &run->request;

    if (strcmp(request->json, "-") != 0 &&
        output_check(request->json, run->error, sizeof run->error))
        return -1;
    if (request->save && output_check(request->save, run->error, sizeof run->error))
        return -1;
    return request->rows ? output_check(request->rows, run->error, sizeof run->error) : 0;
}

static int create_learner(struct run *run)
{
    char reason[256];

    run->report.memory = learner_memory(&run->config);
    run->arena = arena_create(run->report.memory);
    if (!run->arena)
        return fail(run, "the learner", "no memory for this capacity");
    run->learner = learner_create(&run->config, run->arena, reason, sizeof reason);
    if (!run->learner)
        return fail(run, "the learner", reason);
    seeker_init(&run->seeker, &run->config);
    return run->request.load
               ? model_file_load(run->request.load, run->learner, run->error, sizeof run->error)
               : 0;
}

/* One line on a terminal, overwritten; at most once a second. */
static void show_progress(struct run *run, size_t done, const char *what)
{
    time_t now = time(NULL);

    if (run->request.quiet || !isatty(STDERR_FILENO) || now == run->last_progress)
        return;
    run->last_progress = now;
    fprintf(stderr, "\r\033[K%s: %zu, %d experts", what, done,
            learner_get_statistics(run->learner).experts);
    if (run->seeker.searches > 0)
        fprintf(stderr, ", %d searches for a body: %s", run->seeker.searches,
                run->seeker.report.why);
}

static void clear_progress(struct run *run)
{
    if (run->last_progress)
        fputs("\r\033[K", stderr);
    run->last_progress = 0;
}

static bool has_body(const struct run *run)
{
    return run->config.kind == LEARNER_IMLE && run->config.features == LEARNER_BODY;
}

static void learn_next(struct run *run)
{
    while (run->row == run->train[run->file].n_rows) {
        run->file++;
        run->row = 0;
    }
    const struct csv_table *table = &run->train[run->file];
    const double *z = csv_input(table, run->row);
    const double *x = csv_output(table, run->row++);
    bool sound = health_look(&run->health, z, x);
    if (!sound && !run->request.keeps_frozen)
        return;
    int64_t start = durations_clock();
    health_count(&run->health, learner_update(run->learner, z, x));
    durations_add(&run->updates, start);
    if (has_body(run)) /* no part of the update: beside a robot it has a process of its own */
        seeker_look(&run->seeker, run->learner);
}

static int score_sets(struct run *run, struct report_result *result)
{
    const struct request *request = &run->request;
    const bool is_last = run->report.n_results == request->n_at - 1;
    const struct score_desk desk = {run->learner, &run->predictions,
                                    request->rows && is_last ? &run->rows : NULL, &run->health};

    result->sets = calloc((size_t)request->n_sets + 1, sizeof *result->sets);
    if (!result->sets)
        return fail(run, "the report", "out of memory");
    for (int i = 0; i < request->n_sets; i++) {
        struct report_set *set = &result->sets[i];
        const char *name = request->sets[i].name;
        show_progress(run, result->at, name);
        if (request->sets[i].is_track)
            set->track = score_track(&desk, name, &run->sets[i]);
        else
            set->test = score_test(&desk, name, &run->sets[i]);
    }
    return 0;
}

static int evaluate(struct run *run)
{
    const struct request *request = &run->request;
    size_t done = 0;

    for (int i = 0; i < request->n_at; i++) {
        struct report_result *result = &run->report.results[i];
        for (; done < request->at[i]; done++) {
            learn_next(run);
            show_progress(run, done, "samples");
        }
        result->at = done;
        if (score_sets(run, result))
            return -1;
        result->frozen = run->health.frozen;
        result->statistics = learner_get_statistics(run->learner);
        result->has_body = has_body(run);
        result->seeker = run->seeker;
        result->change = learner_get_body_change(run->learner);
        result->has_rest = learner_not_rigid(run->learner, result->not_rigid) == 0;
        result->update = durations_summarise(&run->updates);
        result->predict = durations_summarise(&run->predictions);
        durations_clear(&run->updates);
        durations_clear(&run->predictions);
        run->report.n_results++;
        clear_progress(run);
        if (!request->quiet && strcmp(request->json, "-") != 0)
            report_print(request, result, stdout);
    }
    return 0;
}

static void look_after_health(struct run *run)
{
    const struct csv_table *first = run->request.n_train > 0 ? &run->train[0] : NULL;

    health_init(&run->health, &run->config, 0);
    if (!first || !first->names)
        return;
    for (int i = 0; i < run->request.n_inputs; i++)
        run->input_names[i] = first->names[i];
    run->health.names = run->input_names;
}

static void warn(struct run *run)
{
    const struct learner_statistics statistics = learner_get_statistics(run->learner);

    clear_progress(run);
    warnings_of_health(&run->warnings, &run->health, &statistics);
    for (int i = 0; i < run->request.n_sets; i++)
        warnings_of_set(&run->warnings, &run->health, run->request.sets[i].path, &run->sets[i]);
}

static int write_report(struct run *run)
{
    struct output_file file;

    if (strcmp(run->request.json, "-") == 0) {
        report_to_json(&run->report, stdout);
        return fflush(stdout) == 0 ? 0 : fail(run, "standard output", "cannot be written");
    }
    if (output_begin(&file, run->request.json, run->error, sizeof run->error))
        return -1;
    report_to_json(&run->report, file.stream);
    return output_commit(&file, run->error, sizeof run->error);
}

static int carry_out(struct run *run)
{
    if (read_config(run) || check_outputs(run) || read_tables(run) || create_learner(run))
        return -1;
    run->report.request = &run->request;
    run->report.config = &run->config;
    run->report.train = run->train;
    run->report.warnings = &run->warnings;
    look_after_health(run);
    if (run->request.rows && rows_begin(&run->rows, run->request.rows, run->request.n_outputs,
                                        run->error, sizeof run->error))
        return -1;
    if (evaluate(run))
        return -1;
    warn(run);
    if (run->request.rows && rows_end(&run->rows, run->error, sizeof run->error))
        return -1;
    if (run->request.save &&
        model_file_save(run->request.save, run->learner, run->error, sizeof run->error))
        return -1;
    return write_report(run);
}

static void free_run(struct run *run)
{
    for (int i = 0; run->train && i < run->request.n_train; i++)
        csv_free(&run->train[i]);
    for (int i = 0; run->sets && i < run->request.n_sets; i++)
        csv_free(&run->sets[i]);
    for (int i = 0; i < run->report.n_results + 1 && i < REQUEST_MOST_COUNTS; i++)
        free(run->report.results[i].sets);
    free(run->train);
    free(run->sets);
    durations_free(&run->updates);
    durations_free(&run->predictions);
    arena_destroy(run->arena);
    request_free(&run->request);
    free(run);
}

int main(int argc, char **argv)
{
    struct run *run = calloc(1, sizeof *run);
    int code = EXIT_FAILURE;

    if (!run) {
        fputs("reach-eval: out of memory\n", stderr);
        return code;
    }
    code = request_read(argc, argv, &run->request);
    if (code < 0) {
        code = carry_out(run) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
        if (code)
            fprintf(stderr, "reach-eval: %s\n", run->error);
    }
    free_run(run);
    return code;
}
