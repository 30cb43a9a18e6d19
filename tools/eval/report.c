#include "tools/eval/report.h"

#include <math.h>

#include "common/program/version.h"
#include "tools/measure/json.h"
#include "tools/measure/learner_options.h"

static void durations_to_json(const struct durations_summary *d, const char *key, struct json *json)
{
    json_object(json, key);
    json_count(json, "n", d->n);
    json_number(json, "mean", d->mean);
    json_number(json, "p50", d->p50);
    json_number(json, "p99", d->p99);
    json_number(json, "p999", d->p999);
    json_number(json, "max", d->max);
    json_end_object(json);
}

static void error_to_json(const struct score_error *error, int n_outputs, const char *key,
                          struct json *json)
{
    json_object(json, key);
    json_count(json, "n", error->n);
    json_numbers(json, "rmse", n_outputs, error->rmse);
    json_number(json, "mean", error->mean);
    json_number(json, "median", error->median);
    json_number(json, "p95", error->p95);
    json_end_object(json);
}

static void calibration_to_json(const struct score_calibration *calibration, struct json *json)
{
    json_object(json, "calibration");
    json_count(json, "n", calibration->n);
    json_number(json, "median", calibration->median);
    json_number(json, "p95", calibration->p95);
    json_end_object(json);
}

static void jacobian_to_json(const struct score_jacobian *jacobian, struct json *json)
{
    json_object(json, "jacobian");
    json_count(json, "n", jacobian->n);
    json_number(json, "median", jacobian->median);
    json_number(json, "mean", jacobian->mean);
    json_end_object(json);
}

static void test_to_json(const struct score_test *test, int n_outputs, const char *name,
                         struct json *json)
{
    double n_with[LEARNER_MAX_SOLUTIONS + 1];

    for (int i = 0; i <= LEARNER_MAX_SOLUTIONS; i++)
        n_with[i] = (double)test->n_with[i];
    json_object(json, name);
    json_count(json, "rows", test->n_rows);
    json_count(json, "unanswered", test->n_unanswered);
    error_to_json(&test->closest, n_outputs, "closest", json);
    error_to_json(&test->strongest, n_outputs, "strongest", json);
    error_to_json(&test->single, n_outputs, "single", json);
    calibration_to_json(&test->calibration, json);
    json_number(json, "solutions", test->mean_solutions);
    json_numbers(json, "solutions_histogram", LEARNER_MAX_SOLUTIONS + 1, n_with);
    jacobian_to_json(&test->jacobian, json);
    json_end_object(json);
}

static void track_to_json(const struct score_track *track, int n_outputs, const char *name,
                          struct json *json)
{
    json_object(json, name);
    json_count(json, "rows", track->n_rows);
    json_count(json, "unanswered", track->n_unanswered);
    error_to_json(&track->followed, n_outputs, "followed", json);
    error_to_json(&track->closest, n_outputs, "closest", json);
    error_to_json(&track->strongest, n_outputs, "strongest", json);
    calibration_to_json(&track->calibration, json);
    json_count(json, "wrong", track->n_wrong);
    json_number(json, "wrong_branch", track->wrong_branch);
    json_number(json, "solutions", track->mean_solutions);
    jacobian_to_json(&track->jacobian, json);
    json_end_object(json);
}

static void sets_to_json(const struct request *request, const struct report_result *result,
                         bool tracks, struct json *json)
{
    json_object(json, tracks ? "track" : "test");
    for (int i = 0; i < request->n_sets; i++) {
        const char *name = request->sets[i].name;
        if (request->sets[i].is_track != tracks)
            continue;
        if (tracks)
            track_to_json(&result->sets[i].track, request->n_outputs, name, json);
        else
            test_to_json(&result->sets[i].test, request->n_outputs, name, json);
    }
    json_end_object(json);
}

/* The newest change's cause by its number, from 1: an input, or "view". */
static void change_to_json(const struct learner_body_change *change, int n_inputs,
                           struct json *json)
{
    json_count(json, "changes", (size_t)change->changes);
    if (change->cause >= n_inputs)
        json_text(json, "changed", "view");
    else if (change->cause >= 0)
        json_count(json, "changed", (size_t)change->cause + 1);
    if (change->cause >= 0)
        json_numbers(json, "changed_by", change->cause < n_inputs ? 1 : 3, change->by);
    json_number(json, "slip", change->slip);
}

/* Of the newest search; `found` says whether the learner stands on a body. */
static void body_to_json(const struct report_result *result, int n_inputs, struct json *json)
{
    const struct seeker *seeker = &result->seeker;
    static const char *const outcomes[] = {"found", "not yet", "no chain"};
    const struct finder_report *newest = &seeker->report;

    json_object(json, "body");
    json_bool(json, "found", seeker->found > 0);
    json_text(json, "outcome", seeker->searches > 0 ? outcomes[newest->outcome] : "not yet");
    json_text(json, "why", newest->why);
    json_count(json, "samples", (size_t)newest->samples);
    json_count(json, "starts", (size_t)newest->starts);
    json_number(json, "error", newest->error);
    json_number(json, "doubt", newest->doubt);
    json_count(json, "searches", (size_t)seeker->searches);
    json_number(json, "seconds", seeker->seconds);
    json_count(json, "found_at", (size_t)seeker->found_at);
    json_number(json, "found_seconds", seeker->found > 0 ? seeker->found_seconds : NAN);
    change_to_json(&result->change, n_inputs, json);
    if (result->has_rest)
        json_numbers(json, "not_rigid", 3, result->not_rigid);
    json_end_object(json);
}

static void result_to_json(const struct request *request, const struct report_result *result,
                           struct json *json)
{
    const struct learner_statistics *statistics = &result->statistics;

    json_object(json, NULL);
    json_count(json, "at", result->at);
    json_number(json, "experts", statistics->experts);
    json_count(json, "samples", statistics->samples);
    json_count(json, "births", statistics->births);
    json_count(json, "outliers", statistics->outliers);
    json_count(json, "full", statistics->full);
    json_count(json, "refused", statistics->refused);
    json_count(json, "frozen", result->frozen);
    if (result->has_body)
        body_to_json(result, request->n_inputs, json);
    durations_to_json(&result->update, "update_us", json);
    durations_to_json(&result->predict, "predict_us", json);
    sets_to_json(request, result, false, json);
    sets_to_json(request, result, true, json);
    json_end_object(json);
}

static void sources_to_json(const struct report *report, struct json *json)
{
    const struct request *request = report->request;

    json_array(json, "config");
    for (int i = 0; i < request->n_files; i++)
        json_text(json, NULL, request->files[i]);
    json_end_array(json);
    json_object(json, "parameters");
    learner_options_to_json(report->config, json);
    json_end_object(json);
    json_array(json, "train");
    for (int i = 0; i < request->n_train; i++) {
        json_object(json, NULL);
        json_text(json, "file", request->train[i]);
        json_count(json, "rows", report->train[i].n_rows);
        json_end_object(json);
    }
    json_end_array(json);
    json_text(json, "load", request->load);
    json_text(json, "save", request->save);
}

void report_to_json(const struct report *report, FILE *out)
{
    struct json json = {.out = out};

    json_object(&json, NULL);
    json_text(&json, "program", "reach-eval");
    json_text(&json, "version", reach_version);
    json_text(&json, "learner", request_learner_name(report->request->kind));
    json_number(&json, "inputs", report->request->n_inputs);
    json_number(&json, "outputs", report->request->n_outputs);
    json_count(&json, "memory", report->memory);
    sources_to_json(report, &json);
    warnings_to_json(report->warnings, &json);
    json_array(&json, "results");
    for (int i = 0; i < report->n_results; i++)
        result_to_json(report->request, &report->results[i], &json);
    json_end_array(&json);
    json_end_object(&json);
}

static void print_times(const char *call, const struct durations_summary *times, FILE *out)
{
    if (times->n > 0)
        fprintf(out, ", %s %.1f us (99.9 %%: %.1f)", call, times->p50, times->p999);
}

static void print_error(const char *kind, const struct score_error *error, FILE *out)
{
    fprintf(out, "%s %.5g (median %.3g, 95 %% %.3g)  ", kind, error->mean, error->median,
            error->p95);
}

static void print_calibration(const struct score_calibration *calibration, FILE *out)
{
    fprintf(out, "error/sd %.2f, 95 %% %.2f\n", calibration->median, calibration->p95);
}

static void print_set(const struct request_set *set, const struct report_set *score, FILE *out)
{
    const struct score_test *test = &score->test;
    const struct score_track *track = &score->track;

    fprintf(out, "  %-8s ", set->name);
    if (set->is_track) {
        print_error("followed", &track->followed, out);
        fprintf(out, "closest %.5g  strongest %.5g  wrong %.3g %%  solutions %.3f  ",
                track->closest.mean, track->strongest.mean, 100 * track->wrong_branch,
                track->mean_solutions);
        print_calibration(&track->calibration, out);
    } else {
        print_error("closest", &test->closest, out);
        print_error("strongest", &test->strongest, out);
        fprintf(out, "single %.5g  solutions %.3f  ", test->single.mean, test->mean_solutions);
        print_calibration(&test->calibration, out);
    }
}

void report_print(const struct request *request, const struct report_result *result, FILE *out)
{
    fprintf(out, "%zu samples, %d experts", result->at, result->statistics.experts);
    print_times("update", &result->update, out);
    print_times("predict", &result->predict, out);
    fputc('\n', out);
    if (result->has_body && result->seeker.searches > 0)
        fprintf(out, "  body: %s, %d searches, %.1f s\n", result->seeker.report.why,
                result->seeker.searches, result->seeker.seconds);
    if (result->has_rest)
        fprintf(out, "  no rigid chain explains %.3g %.3g %.3g of the outputs\n",
                result->not_rigid[0], result->not_rigid[1], result->not_rigid[2]);
    if (result->change.changes > 0)
        fprintf(out, "  the body has changed %llu times, the last in %s %d\n",
                (unsigned long long)result->change.changes,
                result->change.cause < request->n_inputs ? "joint" : "the view, number",
                result->change.cause + 1);
    for (int i = 0; i < request->n_sets; i++)
        print_set(&request->sets[i], &result->sets[i], out);
    fflush(out);
}
