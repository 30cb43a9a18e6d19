#include "tools/log/info.h"

#include "common/program/printable.h"
#include "tools/measure/json.h"

#include <string.h>
#include <time.h>

enum { NAME = 4 * EVENT_LOG_CHANNEL, GAPS_SHOWN = 10, WIDEST = 40 };

/* "2026-11-30 20:07:17.123456"; a number of microseconds where that is no time of a calendar. */
static void write_time(int64_t stamp, char *text, size_t size)
{
    int64_t us = ((stamp % 1000000) + 1000000) % 1000000;
    time_t seconds = (time_t)((stamp - us) / 1000000);
    struct tm calendar;
    size_t length = gmtime_r(&seconds, &calendar) && calendar.tm_year < 8100
                        ? strftime(text, size, "%Y-%m-%d %H:%M:%S", &calendar)
                        : 0;

    if (length)
        snprintf(text + length, size - length, ".%06lld", (long long)us);
    else
        snprintf(text, size, "%lld us", (long long)stamp);
}

static double seconds_between(int64_t first, int64_t last)
{
    return ((double)last - (double)first) * 1e-6;
}

/* Messages a second; 0 where there is one. */
static double rate_of(const struct survey_channel *channel)
{
    double seconds = seconds_between(channel->first, channel->last);

    return seconds > 0 ? (double)(channel->messages - 1) / seconds : 0;
}

static void write_type(const struct survey_channel *channel, char *text, size_t size)
{
    const char *also = channel->mixed ? " and others" : "";
    const struct message_type *expected = message_type_of_channel(channel->name);

    if (!channel->type)
        snprintf(text, size, "not ours (%016llx)%s", (unsigned long long)channel->fingerprint,
                 also);
    else if (expected && !message_type_same(expected, channel->type))
        snprintf(text, size, "%s, not %s%s", channel->type->name, expected->name, also);
    else
        snprintf(text, size, "%s%s", channel->type->name, also);
}

/* So wide that the names leave the columns in line, where they are not too long for that. */
static int name_width(const struct survey *survey)
{
    size_t width = 20;

    for (size_t i = 0; i < survey->n_channels; i++) {
        size_t length = strlen(survey->channel[i].name);
        width = length > width && length <= WIDEST ? length : width;
    }
    return (int)width;
}

static void print_channels(const struct survey *survey, FILE *out)
{
    char name[NAME], type[96];
    int width = name_width(survey);

    fprintf(out, "\n%-*s %-30s %9s %9s %9s %9s %10s\n", width, "channel", "type", "messages", "kB",
            "each s", "pause s", "from s");
    for (size_t i = 0; i < survey->n_channels; i++) {
        const struct survey_channel *channel = &survey->channel[i];
        write_type(channel, type, sizeof type);
        fprintf(out, "%-*s %-30s %9lld %9.1f %9.1f %9.3f %10.3f\n", width,
                printable(channel->name, EVENT_LOG_CHANNEL, name, sizeof name), type,
                (long long)channel->messages, (double)channel->bytes * 1e-3, rate_of(channel),
                (double)channel->pause * 1e-6, seconds_between(survey->first, channel->first));
    }
}

static void print_gaps(const struct survey *survey, FILE *out)
{
    if (survey->gaps == 0)
        return;
    fprintf(out, "\n%lld bytes are no event:\n", (long long)survey->skipped);
    for (int64_t i = 0; i < survey->gaps && i < GAPS_SHOWN; i++)
        fprintf(out, "  %lld from byte %lld on%s\n", (long long)survey->gap[i].size,
                (long long)survey->gap[i].position,
                survey->torn && i == survey->gaps - 1 ? ": the end, torn" : "");
    if (survey->gaps > GAPS_SHOWN)
        fprintf(out, "  and %lld places more%s\n", (long long)(survey->gaps - GAPS_SHOWN),
                survey->torn ? "; the end is torn" : "");
}

void info_print(const struct survey *survey, const char *path, FILE *out)
{
    char first[64], last[64], name[NAME];
    int64_t runs = survey_runs(survey);

    write_time(survey->first, first, sizeof first);
    write_time(survey->last, last, sizeof last);
    fprintf(out, "%s: %lld messages on %zu channels, %.1f kB\n",
            printable(path, strlen(path), name, sizeof name), (long long)survey->events,
            survey->n_channels, (double)survey->bytes * 1e-3);
    fprintf(out, "%s to %s UTC, %.3f s", first, last, seconds_between(survey->first, survey->last));
    if (survey->turned_back)
        fprintf(out, "; the clock was set back %lld times", (long long)survey->turned_back);
    if (runs)
        fprintf(out, "; %lld %s of reachd", (long long)runs, runs == 1 ? "run" : "runs");
    fputc('\n', out);
    print_channels(survey, out);
    print_gaps(survey, out);
}

static void channel_json(struct json *json, const struct survey_channel *channel)
{
    char name[NAME];

    json_object(json, NULL);
    json_text(json, "channel", printable(channel->name, EVENT_LOG_CHANNEL, name, sizeof name));
    json_text(json, "type", channel->type ? channel->type->name : NULL);
    json_bool(json, "other_types", channel->mixed);
    json_integer(json, "messages", channel->messages);
    json_integer(json, "bytes", channel->bytes);
    json_number(json, "per_second", rate_of(channel));
    json_number(json, "longest_pause", (double)channel->pause * 1e-6);
    json_integer(json, "first", channel->first);
    json_integer(json, "last", channel->last);
    json_end_object(json);
}

void info_print_json(const struct survey *survey, FILE *out)
{
    struct json json = {.out = out};

    json_object(&json, NULL);
    json_integer(&json, "bytes", survey->bytes);
    json_integer(&json, "messages", survey->events);
    json_integer(&json, "runs", survey_runs(survey));
    json_integer(&json, "first", survey->first);
    json_integer(&json, "last", survey->last);
    json_integer(&json, "clock_set_back", survey->turned_back);
    json_integer(&json, "skipped_places", survey->gaps);
    json_integer(&json, "skipped_bytes", survey->skipped);
    json_bool(&json, "torn_end", survey->torn);
    json_array(&json, "skipped");
    for (int64_t i = 0; i < survey->gaps && i < SURVEY_GAPS; i++) {
        json_object(&json, NULL);
        json_integer(&json, "position", survey->gap[i].position);
        json_integer(&json, "bytes", survey->gap[i].size);
        json_end_object(&json);
    }
    json_end_array(&json);
    json_array(&json, "channels");
    for (size_t i = 0; i < survey->n_channels; i++)
        channel_json(&json, &survey->channel[i]);
    json_end_array(&json);
    json_end_object(&json);
}
