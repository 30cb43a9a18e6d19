#include "tools/reachctl/view/top_view.h"

#include "common/bus/status_words.h"
#include "common/program/printable.h"
#include "tools/reachctl/view/show.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#define DEGREES (180.0 / 3.14159265358979323846)

static const int64_t silent_us = 1000000; /* after that long, what was said is old */
static const int64_t late_us = 500000;    /* so long may a message wait for us */
static const int64_t told_us = 5000000;   /* so long is it told that one waited longer */
static const char level[] = " .:-=+*#%@";

struct page {
    FILE *out;
    int width, height, row;
    bool terminal;
};

enum look { LOOK_PLAIN, LOOK_TITLE, LOOK_ALARM };

static const char *const colour[] = {"", "\033[1m", "\033[1;31m"};

void top_hear(struct top *top, const char *channel, const void *data, size_t size, int64_t now)
{
    rates_count(&top->rates, channel, data, size, now);
    if (strcmp(channel, "REACH_STATUS") == 0) {
        if (reach_status_t_decode(data, 0, (int)size, &top->status) >= 0)
            top->status_at = now;
    } else if (strcmp(channel, "ROBOT_STATE") == 0) {
        if (reach_robot_state_t_decode(data, 0, (int)size, &top->robot) >= 0)
            top->robot_at = now;
    } else if (strcmp(channel, "ROBOT_COMMAND") == 0) {
        if (reach_robot_command_t_decode(data, 0, (int)size, &top->command) >= 0)
            top->command_at = now;
    }
}

void top_note_lateness(struct top *top, int64_t waited, int64_t now)
{
    if (waited <= late_us)
        return;
    if (now - top->late_at > told_us || waited > top->lateness)
        top->lateness = waited;
    top->late_at = now;
}

static void note_error(struct top *top)
{
    if (top->n_errors == TOP_HISTORY)
        memmove(top->errors, top->errors + 1, sizeof top->errors - sizeof top->errors[0]);
    else
        top->n_errors++;
    top->errors[top->n_errors - 1] = isfinite(top->status.error) ? show_error(&top->status) : 0;
}

void top_settle(struct top *top, int64_t now)
{
    double seconds = rates_settle(&top->rates, now);

    if (seconds <= 0 || top->status_at == 0)
        return;
    top->speed =
        top->speed_from ? (double)(top->status.utime - top->speed_from) * 1e-6 / seconds : 0;
    top->speed_from = top->status.utime;
    note_error(top);
}

/* One line, cut at the page's width; nothing when the page is full. */
__attribute__((format(printf, 3, 4))) static void line(struct page *page, enum look look,
                                                       const char *format, ...)
{
    char text[512];
    va_list arguments;

    if (page->row >= page->height)
        return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (page->terminal && page->row > 0)
        fputs("\r\n", page->out);
    page->row++;
    if (page->terminal)
        fprintf(page->out, "%s%.*s\033[0m\033[K", colour[look], page->width, text);
    else
        fprintf(page->out, "%.*s\n", page->width, text);
}

static void draw_title(struct page *page, const struct top *top, int64_t now)
{
    const reach_status_t *status = &top->status;
    double age = (double)(now - top->status_at) * 1e-6;
    char speed[48] = "";

    if (top->speed > 0)
        snprintf(speed, sizeof speed, ", %.1f times real time", top->speed);
    if (top->status_at == 0)
        line(page, LOOK_ALARM, "reachd has not been heard");
    else if (now - top->status_at > silent_us)
        line(page, LOOK_ALARM, "reachd has been silent for %.0f s; before that: %s", age,
             show_state(status));
    else
        line(page, status->state == REACH_STATUS_T_FAULT ? LOOK_ALARM : LOOK_TITLE,
             "reachd %s, %s, %s   robot time %.2f s%s", show_state(status), show_behaviour(status),
             show_phase(status), (double)status->utime * 1e-6, speed);
}

/* What is shown is of a past that grows, or parts of it were lost. */
static void draw_lateness(struct page *page, const struct top *top, int64_t now)
{
    if (now - top->late_at <= told_us && top->late_at != 0)
        line(page, LOOK_ALARM, "top cannot keep up: what it shows is up to %.1f s old",
             (double)top->lateness * 1e-6);
    if (top->dropped > 0)
        line(page, LOOK_ALARM,
             "%lld packets found a full socket since top was started, so that messages were lost",
             (long long)top->dropped);
}

static void draw_error(struct page *page, const struct top *top)
{
    char curve[TOP_HISTORY + 1] = "";
    double most = 0;

    for (int i = 0; i < top->n_errors; i++)
        most = fmax(most, top->errors[i]);
    for (int i = 0; i < top->n_errors; i++)
        curve[i] = most > 0 ? level[lround(top->errors[i] / most * (sizeof level - 2))] : level[0];
    line(page, LOOK_PLAIN, "error      %.1f %s; last minute, at most %.1f %s: |%s|",
         show_error(&top->status), show_error_unit(&top->status), most,
         show_error_unit(&top->status), curve);
}

static void draw_status(struct page *page, const struct top *top)
{
    const reach_status_t *s = &top->status;
    char body[128];
    int64_t troubles = s->overruns + s->slips + s->bad_inputs + s->gated + s->dropped_samples;

    line(page, LOOK_PLAIN, "progress   %d of %d, %d given up; marker %s%s; request %s", s->progress,
         s->progress_total, s->skipped, s->marker_seen ? "seen" : "not seen",
         s->fixated ? ", fixated" : "", status_result_word(s->request_result));
    line(page, LOOK_PLAIN,
         "model      %lld samples, %d experts; %d solutions, in use %d; context %d of %d",
         (long long)s->samples, s->experts, s->solutions, s->solution, s->context, s->contexts);
    show_body(s, body, sizeof body);
    line(page, LOOK_PLAIN, "body       %s", body);
    draw_error(page, top);
    line(page, LOOK_PLAIN, "tick       %.0f us, %.0f mean, %.0f p99.9, %.0f largest; wake-up %.0f",
         s->compute_us, s->compute_mean_us, s->compute_p999_us, s->compute_max_us, s->wakeup_us);
    line(page, troubles ? LOOK_ALARM : LOOK_PLAIN,
         "trouble    %lld overruns, %lld slips, %lld bad inputs, %lld gated, %lld dropped",
         (long long)s->overruns, (long long)s->slips, (long long)s->bad_inputs, (long long)s->gated,
         (long long)s->dropped_samples);
}

/* One row of numbers, such as positions, in degrees. */
static void draw_joint_row(struct page *page, const char *what, const double *values, int n)
{
    char text[256];
    int length = snprintf(text, sizeof text, "%-15s", what);

    for (int i = 0; i < n && i < 16; i++)
        length += snprintf(text + length, sizeof text - (size_t)length, " %6.1f",
                           fmax(-9999, fmin(9999, values[i] * DEGREES)));
    line(page, LOOK_PLAIN, "%s", text);
}

static void draw_joints(struct page *page, const struct top *top)
{
    char title[256];
    int length = snprintf(title, sizeof title, "%-15s", "joint");

    if (!top->robot_at)
        return;
    for (int i = 0; i < top->robot.n_joints && i < 16; i++)
        length += snprintf(title + length, sizeof title - (size_t)length, " %6d", i + 1);
    line(page, LOOK_TITLE, "%s", title);
    draw_joint_row(page, "position deg", top->robot.position, top->robot.n_joints);
    draw_joint_row(page, "velocity deg/s", top->robot.velocity, top->robot.n_joints);
    if (top->command_at)
        draw_joint_row(page, "command deg/s", top->command.velocity, top->command.n_joints);
}

/* Of a message that is not laid out as its channel wants it, or is on a channel that is not ours.
 */
static const char *type_of(const struct rate *rate)
{
    const struct message_type *wanted = message_type_of_channel(rate->channel);

    if (!rate->type)
        return wanted ? "another version" : "not ours";
    return wanted && !message_type_same(wanted, rate->type) ? "wrong type" : rate->type->name;
}

static void draw_channel(struct page *page, const struct rate *rate, int64_t now)
{
    double age = (double)(now - rate->last) * 1e-6;
    char channel[4 * RATES_NAME];
    char counts[64] = "       -         -         -";

    if (now - rate->last <= silent_us)
        snprintf(counts, sizeof counts, "%8.1f %9.1f %9.2f", rate->per_second,
                 rate->bytes_per_second * 1e-3, rate->jitter * 1e-3);
    line(page, LOOK_PLAIN, "%-24.24s %s %8.3f %8.1f  %s",
         printable(rate->channel, RATES_NAME, channel, sizeof channel), counts,
         (double)rate->longest * 1e-6, age, type_of(rate));
}

static void draw_channels(struct page *page, const struct rates *rates, int64_t now)
{
    int room = page->height - page->row - 1; /* for channels under the title */
    int shown = rates->n <= room ? rates->n : room - 1;

    line(page, LOOK_TITLE, "%-24s %8s %9s %9s %8s %8s  %s", "channel", "each s", "kB/s",
         "jitter ms", "pause s", "silent s", "type");
    for (int i = 0; i < shown; i++)
        draw_channel(page, &rates->rate[i], now);
    if (shown < rates->n)
        line(page, LOOK_PLAIN, "... and %d channels more", rates->n - (shown > 0 ? shown : 0));
    else if (rates->uncounted)
        line(page, LOOK_PLAIN, "... and %lld messages of channels more",
             (long long)rates->uncounted);
}

void top_draw(const struct top *top, int64_t now, int width, int height, bool terminal, FILE *out)
{
    struct page page = {out, width, height, 0, terminal};

    if (terminal)
        fputs("\033[H", out);
    draw_title(&page, top, now);
    draw_lateness(&page, top, now);
    if (top->status_at)
        draw_status(&page, top);
    draw_joints(&page, top);
    draw_channels(&page, &top->rates, now);
    if (terminal)
        fputs("\033[J", out);
    fflush(out);
}
