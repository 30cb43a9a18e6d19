#include "tools/log/extract.h"

#include "tools/measure/output_file.h"

#include <errno.h>
#include <glib.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

struct extraction {
    const struct extract_settings *settings;
    GRegex *pattern; /* NULL: all channels */
    int64_t begin;   /* stamp of the first event */
    struct extract_report *report;
};

/* All of a channel's name must match, even one side of an "A|B". */
static int compile(const char *channels, GRegex **pattern, char *error, size_t error_size)
{
    char *whole = channels ? g_strdup_printf("^(?:%s)$", channels) : NULL;
    GError *reason = NULL;

    *pattern = whole ? g_regex_new(whole, G_REGEX_DOLLAR_ENDONLY, 0, &reason) : NULL;
    g_free(whole);
    if (!reason)
        return 0;
    snprintf(error, error_size, "'%s' is no pattern: %s", channels, reason->message);
    g_error_free(reason);
    return -1;
}

static bool wanted(const struct extraction *extraction, const struct event *event)
{
    const struct extract_settings *settings = extraction->settings;
    double at = ((double)event->stamp - (double)extraction->begin) * 1e-6;

    return (settings->from <= 0 || at >= settings->from) &&
           (settings->to < 0 || at <= settings->to) &&
           (!extraction->pattern || (g_utf8_validate(event->channel, -1, NULL) &&
                                     g_regex_match(extraction->pattern, event->channel, 0, NULL)));
}

static int copy_events(struct extraction *extraction, struct event_log *log, FILE *to, char *error,
                       size_t error_size)
{
    struct extract_report *report = extraction->report;
    struct event event;
    int result;

    while ((result = event_log_next(log, &event, error, error_size)) > 0) {
        size_t size;
        const unsigned char *bytes = event_log_bytes(log, &event, &size);
        if (report->taken + report->left == 0)
            extraction->begin = event.stamp;
        report->skipped += event.skipped;
        if (!wanted(extraction, &event)) {
            report->left++;
            continue;
        }
        report->taken++;
        if (!bytes || fwrite(bytes, 1, size, to) != size) {
            snprintf(error, error_size, "%s", strerror(errno));
            return -1;
        }
    }
    report->skipped += event.skipped;
    return result;
}

static int write_file(struct extraction *extraction, struct event_log *log, const char *path,
                      char *error, size_t error_size)
{
    struct output_file file;
    char reason[256];

    if (output_begin(&file, path, error, error_size))
        return -1;
    if (copy_events(extraction, log, file.stream, reason, sizeof reason) == 0 &&
        extraction->report->taken > 0)
        return output_commit(&file, error, error_size);
    if (extraction->report->taken == 0)
        snprintf(reason, sizeof reason, "no event is wanted, so nothing is written");
    snprintf(error, error_size, "%s: %s", path, reason);
    fclose(file.stream);
    unlink(file.part);
    return -1;
}

int extract(struct event_log *log, const struct extract_settings *settings, const char *path,
            struct extract_report *report, char *error, size_t error_size)
{
    struct extraction extraction = {.settings = settings, .report = report};
    int result;

    *report = (struct extract_report){0};
    if (access(path, F_OK) == 0) {
        snprintf(error, error_size, "%s: is there already, and is not overwritten", path);
        return -1;
    }
    if (compile(settings->channels, &extraction.pattern, error, error_size))
        return -1;
    result = write_file(&extraction, log, path, error, error_size);
    if (extraction.pattern)
        g_regex_unref(extraction.pattern);
    return result;
}
