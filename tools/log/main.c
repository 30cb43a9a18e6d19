/* reach-log: what is in a log of lcm-logger's, and parts of it. */
#include "common/logs/event_log.h"
#include "common/options/command_line.h"
#include "common/program/printable.h"
#include "tools/log/extract.h"
#include "tools/log/info.h"
#include "tools/log/survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    struct command_words words; /* the command and its files */
    bool json;
    struct extract_settings extract;
};

static int seconds(const char *text, double *value, char *error, size_t error_size)
{
    char *end;

    *value = strtod(text, &end);
    if (end != text && *end == '\0' && *value >= 0 && isfinite(*value))
        return 0;
    snprintf(error, error_size, "'%s': a number of seconds is wanted", text);
    return -1;
}

static int take_from(void *user, const char *text, char *error, size_t error_size)
{
    return seconds(text, &((struct arguments *)user)->extract.from, error, error_size);
}

static int take_to(void *user, const char *text, char *error, size_t error_size)
{
    return seconds(text, &((struct arguments *)user)->extract.to, error, error_size);
}

static int take_word(void *user, const char *text, char *error, size_t error_size)
{
    return command_words_take(&((struct arguments *)user)->words, text, error, error_size);
}

static const struct argument_row rows[] = {
    ARGUMENT_ON("json", 0, struct arguments, json, "info: as JSON"),
    ARGUMENT_CALL("from", "S", take_from, "cut: begin S seconds after the log's first stamp"),
    ARGUMENT_CALL("to", "S", take_to, "cut: end S seconds after the log's first stamp"),
    ARGUMENT_TEXT("channels", 0, "PATTERN", struct arguments, extract.channels,
                  "cut: channels whose whole name matches, such as 'REACH_.*' or 'MARKER|SIM_.*'"),
    ARGUMENT_END,
};

static void print_commands(FILE *out)
{
    fputs("commands:\n"
          "  info FILE          channels, types, rates, pauses and damage of a log\n"
          "  cut FILE NEW       a part of it, by time and channels, as a new log\n"
          "  repair FILE NEW    all that is whole in it, as a new log\n"
          "FILE may be '-', which is standard input.\n",
          out);
}

static const struct command_line line = {
    .program = "reach-log",
    .usage = "reach-log info [--json] FILE\n"
             "       reach-log cut [--from S] [--to S] [--channels PATTERN] FILE NEW\n"
             "       reach-log repair FILE NEW",
    .about = "Says what is in a log of lcm-logger's, and makes logs of parts of it. Of a damaged "
             "log it takes every event that is whole, and says how many bytes are none.",
    .rows = rows,
    .exit_status = "0 done, 1 the log cannot be read or the new one not written",
    .print_more = print_commands,
    .take_word = take_word,
};

static int show_info(struct event_log *log, const struct arguments *arguments, char *error,
                     size_t error_size)
{
    struct survey *survey = calloc(1, sizeof *survey);
    int result = -1;

    snprintf(error, error_size, "out of memory");
    if (survey && survey_read(survey, log, error, error_size) == 0) {
        result = survey->events > 0 ? 0 : -1;
        if (result)
            snprintf(error, error_size, "there is no event of an LCM log in it");
        else if (arguments->json)
            info_print_json(survey, stdout);
        else
            info_print(survey, arguments->words.word[1], stdout);
    }
    if (survey)
        survey_free(survey);
    free(survey);
    return result;
}

static int make_log(struct event_log *log, const struct arguments *arguments, char *error,
                    size_t error_size)
{
    struct extract_report report;

    if (extract(log, &arguments->extract, arguments->words.word[2], &report, error, error_size))
        return -1;
    printf("reach-log: %s: %lld events", arguments->words.word[2], (long long)report.taken);
    if (report.left)
        printf(", %lld not asked for", (long long)report.left);
    if (report.skipped)
        printf(", %lld bytes that are no event left out", (long long)report.skipped);
    putchar('\n');
    return 0;
}

static int carry_out(const struct arguments *arguments, char *error, size_t error_size)
{
    const char *path = arguments->words.word[1];
    struct event_log *log = event_log_open(path, EVENT_LOG_KEEP_ALL, error, error_size);
    char reason[400];
    int result;

    if (!log)
        return -1;
    if (arguments->words.n == 2) {
        result = show_info(log, arguments, reason, sizeof reason);
        if (result)
            snprintf(error, error_size, "%s: %s", path, reason);
    } else
        result = make_log(log, arguments, error, error_size);
    event_log_close(log);
    return result;
}

/* What is wrong with the words; NULL: nothing. */
static const char *wrong_words(const struct arguments *arguments)
{
    const struct extract_settings *extract = &arguments->extract;
    const char *command = arguments->words.n ? arguments->words.word[0] : "";
    bool parts = extract->channels || extract->from > 0 || extract->to >= 0;

    if (strcmp(command, "info") == 0)
        return arguments->words.n != 2 ? "info wants a file"
               : parts                 ? "--from, --to and --channels belong to cut"
                                       : NULL;
    if (strcmp(command, "cut") != 0 && strcmp(command, "repair") != 0)
        return "a command is wanted: info, cut or repair";
    if (arguments->words.n != 3)
        return "a log and the name of a new one are wanted";
    if (arguments->json)
        return "--json belongs to info";
    return parts && command[0] == 'r' ? "--from, --to and --channels belong to cut" : NULL;
}

int main(int argc, char **argv)
{
    struct arguments arguments = {.extract = {.to = -1}};
    char error[1600], text[1600];
    int status = command_line_parse(&line, argc, argv, &arguments);
    const char *wrong;

    if (status >= 0)
        return status;
    wrong = wrong_words(&arguments);
    if (wrong)
        return command_line_wrong(&line, "%s", wrong);
    if (carry_out(&arguments, error, sizeof error) == 0 && fflush(stdout) == 0)
        return EXIT_SUCCESS;
    fprintf(stderr, "reach-log: %s\n", printable(error, sizeof error, text, sizeof text));
    return EXIT_FAILURE;
}
