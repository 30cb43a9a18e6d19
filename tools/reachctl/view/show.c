#include "tools/reachctl/view/show.h"

#include "common/bus/refusals_text.h"
#include "common/bus/status_words.h"
#include "common/bus/troubles_text.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>
#include <unistd.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

const char *show_state(const reach_status_t *status)
{
    return status_state_word(status->state);
}

const char *show_behaviour(const reach_status_t *status)
{
    return status_behaviour_word(status->behaviour);
}

const char *show_phase(const reach_status_t *status)
{
    return status_phase_word(status->phase);
}

static const char *result_word(const reach_status_t *status)
{
    return status_result_word(status->request_result);
}

void show_body(const reach_status_t *status, char *text, size_t size)
{
    const char *word = status_body_word(status->body);

    if (status->body == REACH_STATUS_T_BODY_FOUND)
        snprintf(text, size, "%s from %d samples, off by %.2f times the noise, unsure by %.2f %%",
                 word, status->body_samples, status->body_error, 100 * status->body_doubt);
    else
        snprintf(text, size, "%s", word);
}

double show_error(const reach_status_t *status)
{
    return status->space == REACH_STATUS_T_CARTESIAN ? 1e3 * status->error : status->error;
}

const char *show_error_unit(const reach_status_t *status)
{
    return status->space == REACH_STATUS_T_CARTESIAN ? "mm" : "px";
}

static const double degrees = 57.29577951308232;

/* What the body in use has come to since it was found. */
static void show_change(const reach_status_t *status, FILE *out)
{
    const double *by = status->body_changed_by, *rest = status->body_not_rigid;
    bool cartesian = status->space == REACH_STATUS_T_CARTESIAN;

    if (status->body != REACH_STATUS_T_BODY_FOUND)
        return;
    if (cartesian)
        fprintf(out, "           no rigid chain: %.2f %.2f %.2f mm of its motion", 1e3 * rest[0],
                1e3 * rest[1], 1e3 * rest[2]);
    else
        fprintf(out, "           no rigid chain: %.3f deg %.3f deg %.2f px of its motion",
                degrees * rest[0], degrees * rest[1], rest[2]);
    if (status->body_slip > 0)
        fprintf(out, "; a tip has slipped by %.3g%s",
                cartesian ? 1e3 * status->body_slip : status->body_slip, cartesian ? " mm" : "");
    fputc('\n', out);
    if (status->body_changed > 0)
        fprintf(out, "           joint %d's zero has changed by %.2f deg, change %lld\n",
                status->body_changed, degrees * by[0], (long long)status->body_changes);
    else if (status->body_changed < 0)
        fprintf(out, "           the view has changed by %.3g %.3g %.3g, change %lld\n", by[0],
                by[1], by[2], (long long)status->body_changes);
}

/* What was refused, and what is wrong with the samples. */
static void show_wrong(const reach_status_t *status, FILE *out)
{
    char text[512];

    refusals_text(status, NULL, text, sizeof text);
    if (text[0])
        fprintf(out, "refused    %s\n", text);
    for (int kind = 0; kind < TROUBLES; kind++)
        if (trouble_text(status, kind, text, sizeof text))
            fprintf(out, "trouble    %s\n", text);
}

void show_text(const reach_status_t *status, FILE *out)
{
    char body[128], fault[128];

    show_body(status, body, sizeof body);
    fprintf(out, "state      %s, behaviour %s, phase %s\n", show_state(status),
            show_behaviour(status), show_phase(status));
    status_fault_text(status, fault, sizeof fault);
    if (status->fault != REACH_STATUS_T_FAULT_NONE)
        fprintf(out, "fault      %s; reachctl reset-fault leaves it\n", fault);
    fprintf(out, "progress   %d of %d, %d given up; error %.1f %s\n", status->progress,
            status->progress_total, status->skipped, show_error(status), show_error_unit(status));
    fprintf(out, "marker     %s%s\n", status->marker_seen ? "seen" : "not seen",
            status->fixated ? ", fixated" : "");
    fprintf(out, "model      %lld samples, %d experts, %d solutions, in use %d; context %d of %d\n",
            (long long)status->samples, status->experts, status->solutions, status->solution,
            status->context, status->contexts);
    fprintf(out, "body       %s; %lld searches\n", body, (long long)status->body_searches);
    show_change(status, out);
    fprintf(out, "disk       %lld of the model's %lld samples are stored%s\n",
            (long long)status->samples_stored, (long long)status->model_samples,
            status->storing ? "" : "; nothing is being stored");
    fprintf(out,
            "tick       %lld; %.0f us now, %.0f mean, %.0f p99.9, %.0f largest; wake-up %.0f\n",
            (long long)status->seq, status->compute_us, status->compute_mean_us,
            status->compute_p999_us, status->compute_max_us, status->wakeup_us);
    fprintf(out,
            "trouble    %lld overruns, %lld slips, %lld bad inputs, %lld gated, %lld dropped\n",
            (long long)status->overruns, (long long)status->slips, (long long)status->bad_inputs,
            (long long)status->gated, (long long)status->dropped_samples);
    show_wrong(status, out);
    fprintf(out, "age        robot state %.3f s, request %lld %s\n", status->staleness,
            (long long)status->request_seq, result_word(status));
}

enum field_type { FIELD_INT8, FIELD_INT32, FIELD_INT64, FIELD_DOUBLE };

static const struct field {
    const char *name;
    enum field_type type;
    size_t offset;
} fields[] = {
#define FIELD(name, type)                                                                          \
    {                                                                                              \
#name, type, offsetof(reach_status_t, name)                                                \
    }
    FIELD(utime, FIELD_INT64),
    FIELD(seq, FIELD_INT64),
    FIELD(state_seq, FIELD_INT64),
    FIELD(request_seq, FIELD_INT64),
    FIELD(model_request_seq, FIELD_INT64),
    FIELD(progress, FIELD_INT32),
    FIELD(progress_total, FIELD_INT32),
    FIELD(skipped, FIELD_INT32),
    FIELD(marker_seen, FIELD_INT8),
    FIELD(fixated, FIELD_INT8),
    FIELD(space, FIELD_INT8),
    FIELD(error, FIELD_DOUBLE),
    FIELD(samples, FIELD_INT64),
    FIELD(model_samples, FIELD_INT64),
    FIELD(samples_stored, FIELD_INT64),
    FIELD(storing, FIELD_INT8),
    FIELD(store_waits, FIELD_INT64),
    FIELD(experts, FIELD_INT32),
    FIELD(solutions, FIELD_INT32),
    FIELD(solution, FIELD_INT32),
    FIELD(contexts, FIELD_INT32),
    FIELD(context, FIELD_INT32),
    FIELD(body_samples, FIELD_INT32),
    FIELD(body_error, FIELD_DOUBLE),
    FIELD(body_doubt, FIELD_DOUBLE),
    FIELD(body_searches, FIELD_INT64),
    FIELD(body_changes, FIELD_INT64),
    FIELD(body_changed, FIELD_INT32),
    FIELD(body_slip, FIELD_DOUBLE),
    FIELD(compute_us, FIELD_DOUBLE),
    FIELD(compute_mean_us, FIELD_DOUBLE),
    FIELD(compute_p999_us, FIELD_DOUBLE),
    FIELD(compute_max_us, FIELD_DOUBLE),
    FIELD(wakeup_us, FIELD_DOUBLE),
    FIELD(wakeup_mean_us, FIELD_DOUBLE),
    FIELD(wakeup_p999_us, FIELD_DOUBLE),
    FIELD(wakeup_max_us, FIELD_DOUBLE),
    FIELD(overruns, FIELD_INT64),
    FIELD(slips, FIELD_INT64),
    FIELD(page_faults, FIELD_INT64),
    FIELD(queue, FIELD_INT32),
    FIELD(dropped_samples, FIELD_INT64),
    FIELD(bad_inputs, FIELD_INT64),
    FIELD(frozen_samples, FIELD_INT64),
    FIELD(troubles, FIELD_INT32),
    FIELD(trouble_joint, FIELD_INT32),
    FIELD(trouble_value, FIELD_DOUBLE),
    FIELD(trouble_scales, FIELD_DOUBLE),
    FIELD(refused_state, FIELD_INT64),
    FIELD(refused_joint, FIELD_INT32),
    FIELD(refused_value, FIELD_DOUBLE),
    FIELD(refused_min, FIELD_DOUBLE),
    FIELD(refused_max, FIELD_DOUBLE),
    FIELD(gated, FIELD_INT64),
    FIELD(staleness, FIELD_DOUBLE),
#undef FIELD
};

/* JSON has no infinity and no NaN. */
static void print_number(double value, FILE *out)
{
    if (isfinite(value))
        fprintf(out, "%.17g", value);
    else
        fputs("null", out);
}

static void print_field(const reach_status_t *status, const struct field *field, FILE *out)
{
    const void *at = (const char *)status + field->offset;

    switch (field->type) {
    case FIELD_INT8:
        fprintf(out, "%d", *(const int8_t *)at);
        break;
    case FIELD_INT32:
        fprintf(out, "%d", *(const int32_t *)at);
        break;
    case FIELD_INT64:
        fprintf(out, "%lld", (long long)*(const int64_t *)at);
        break;
    case FIELD_DOUBLE:
        print_number(*(const double *)at, out);
        break;
    }
}

static void print_list(const char *name, const double *values, int n, FILE *out)
{
    fprintf(out, ", \"%s\": [", name);
    for (int i = 0; i < n && i < 8; i++) {
        fputs(i ? ", " : "", out);
        print_number(values[i], out);
    }
    fputc(']', out);
}

void show_json(const reach_status_t *status, FILE *out)
{
    fprintf(out, "{\"state\": \"%s\", \"behaviour\": \"%s\", \"phase\": \"%s\"", show_state(status),
            show_behaviour(status), show_phase(status));
    fprintf(out, ", \"fault\": \"%s\"", status_fault_word(status->fault));
    fprintf(out, ", \"body\": \"%s\"", status_body_word(status->body));
    fprintf(out, ", \"request_result\": \"%s\"", result_word(status));
    for (size_t i = 0; i < COUNT(fields); i++) {
        fprintf(out, ", \"%s\": ", fields[i].name);
        print_field(status, &fields[i], out);
    }
    print_list("body_changed_by", status->body_changed_by, 3, out);
    print_list("body_not_rigid", status->body_not_rigid, 3, out);
    print_list("x_predicted", status->x_predicted, status->n_outputs, out);
    print_list("x_estimated", status->x_estimated, status->n_outputs, out);
    fputs("}\n", out);
}

/* Between lines where stderr is no terminal. */
static const time_t progress_seconds = 10;

void show_progress(const reach_status_t *status)
{
    static time_t said;
    bool live = isatty(STDERR_FILENO);
    time_t now = time(NULL);

    if (!said)
        said = now;
    if (!live && now - said < progress_seconds)
        return;
    said = now;
    fprintf(stderr, "%s%s %s: %d of %d, %d given up, %d experts", live ? "\r" : "",
            show_behaviour(status), show_phase(status), status->progress, status->progress_total,
            status->skipped, status->experts);
    if (status->error > 0)
        fprintf(stderr, ", error %.1f %s", show_error(status), show_error_unit(status));
    fputs(live ? "\033[K" : "\n", stderr);
}

void show_end(const reach_status_t *at_work, const reach_status_t *after)
{
    bool has_target = at_work->behaviour == REACH_STATUS_T_REACH ||
                      at_work->behaviour == REACH_STATUS_T_COORDINATE;

    if (isatty(STDERR_FILENO))
        fputs("\r\033[K", stderr);
    printf("%s: %d of %d, %d given up; %d experts", show_behaviour(at_work), after->progress,
           after->progress_total, after->skipped, after->experts);
    if (has_target)
        printf("; error %.1f %s", show_error(at_work), show_error_unit(at_work));
    putchar('\n');
}
