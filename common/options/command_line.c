#include "common/options/command_line.h"

#include "common/program/version.h"

#include <errno.h>
#include <getopt.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum {
    WRONG_USAGE = 2,
    MOST_ROWS = 27,    /* with the three that every program has */
    CODE_OF_ROW = 256, /* getopt's code of the first row; below are letters */
    TYPED_SIZE = 64,   /* an option as help shows it */
    HELP_WIDTH = 96,
};

static const double longest_time = 1e6; /* s */

/* A command line while it is read. */
struct reading {
    const struct command_line *line;
    void *settings;
    char **argv;
    struct argument_row rows[MOST_ROWS];
    int n_rows;
    struct option words[MOST_ROWS + 1];
    char letters[2 * MOST_ROWS + 3];
    const struct argument_row *last; /* option */
};

int command_words_take(struct command_words *words, const char *text, char *error,
                       size_t error_size)
{
    if (words->n == COMMAND_WORDS_MOST) {
        snprintf(error, error_size, "too many arguments");
        return -1;
    }
    words->word[words->n++] = text;
    return 0;
}

int command_line_wrong(const struct command_line *line, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    fprintf(stderr, "%s: ", line->program);
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "; %s --help tells more\n", line->program);
    va_end(arguments);
    return WRONG_USAGE;
}

static void add_row(struct reading *reading, const struct argument_row *row)
{
    const size_t length = strlen(reading->letters);

    reading->words[reading->n_rows] =
        (struct option){row->name, row->value ? required_argument : no_argument, NULL,
                        CODE_OF_ROW + reading->n_rows};
    if (row->letter)
        snprintf(reading->letters + length, sizeof reading->letters - length, "%c%s", row->letter,
                 row->value ? ":" : "");
    reading->rows[reading->n_rows++] = *row;
}

/* The program's own rows, then those that every program has. */
static void add_rows(struct reading *reading)
{
    static const struct argument_row everywhere[] = {
        {"help-options", 0, NULL, ARGUMENT_TYPE_OPTIONS, 0, 0, 0, 0, NULL,
         "list every option of the configuration"},
        {"help", 'h', NULL, ARGUMENT_TYPE_HELP, 0, 0, 0, 0, NULL, "print this"},
        {"version", 'V', NULL, ARGUMENT_TYPE_VERSION, 0, 0, 0, 0, NULL,
         "print the version and git revision"},
    };

    strcpy(reading->letters, "+:"); /* stop at words, tell of values that are missing */
    for (const struct argument_row *row = reading->line->rows; row->name; row++)
        add_row(reading, row);
    for (int i = reading->line->print_options ? 0 : 1; i < 3; i++)
        add_row(reading, &everywhere[i]);
}

static const struct argument_row *row_of(const struct reading *reading, int code)
{
    if (code >= CODE_OF_ROW)
        return &reading->rows[code - CODE_OF_ROW];
    for (int i = 0; code && i < reading->n_rows; i++)
        if (reading->rows[i].letter == code)
            return &reading->rows[i];
    return NULL;
}

static int typed(const struct argument_row *row, char text[TYPED_SIZE])
{
    const char letter[] = {'-', row->letter, ',', '\0'};

    return snprintf(text, TYPED_SIZE, "  %-3s --%s%s%s  ", row->letter ? letter : "", row->name,
                    row->value ? " " : "", row->value ? row->value : "");
}

static void print_wrapped(const char *text, int column)
{
    int at = column;

    while (*text) {
        const int length = (int)strcspn(text, " ");
        if (at > column && at + length >= HELP_WIDTH)
            printf("\n%*s", at = column, "");
        else if (at > column)
            at += printf(" ");
        at += printf("%.*s", length, text);
        text += length;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void print_help(const struct reading *reading)
{
    const struct command_line *line = reading->line;
    char text[TYPED_SIZE];
    int column = 0;

    printf("usage: %s\n\n%s\n\n", line->usage, line->about);
    for (int i = 0; i < reading->n_rows; i++)
        column = typed(&reading->rows[i], text) > column ? (int)strlen(text) : column;
    for (int i = 0; i < reading->n_rows; i++) {
        typed(&reading->rows[i], text);
        printf("%-*s", column, text);
        print_wrapped(reading->rows[i].help, column);
    }
    printf("\nExit status: %s, %d wrong usage.\n", line->exit_status, WRONG_USAGE);
    if (line->print_more) {
        putchar('\n');
        line->print_more(stdout);
    }
}

static int refuse(const struct reading *reading, const struct argument_row *row, const char *reason)
{
    return command_line_wrong(reading->line, "--%s: %s", row->name, reason);
}

static int take_whole(const struct reading *reading, const struct argument_row *row,
                      const char *text, void *place)
{
    char *end;
    long long number;

    errno = 0;
    number = strtoll(text, &end, 10);
    if (end == text || *end || errno || number < row->minimum || number > row->maximum)
        return command_line_wrong(
            reading->line, "--%s: a whole number from %lld to %lld is wanted, not '%s'", row->name,
            (long long)row->minimum, (long long)row->maximum, text);
    if (row->type == ARGUMENT_TYPE_INT)
        *(int *)place = (int)number;
    else
        *(int64_t *)place = number;
    return -1;
}

static int take_seconds(const struct reading *reading, const struct argument_row *row,
                        const char *text, double *seconds)
{
    char *end;

    *seconds = strtod(text, &end);
    if (end == text || *end || !(*seconds > 0 && *seconds < longest_time))
        return refuse(reading, row, "a positive number of seconds is wanted");
    return -1;
}

static int take_pair(const struct reading *reading, const struct argument_row *row,
                     const char *text, const char **pair)
{
    const char *second = reading->argv[optind];

    if (!second || second[0] == '-')
        return refuse(reading, row, "two words are wanted");
    pair[0] = text;
    pair[1] = second;
    optind++;
    return -1;
}

static int take_listed(const struct reading *reading, const struct argument_row *row,
                       const char *text, const char **list)
{
    int *n = (int *)(void *)((char *)reading->settings + row->count_offset);

    if (*n == row->maximum)
        return command_line_wrong(reading->line, "--%s: more than %d", row->name, *n);
    list[(*n)++] = text;
    return -1;
}

static int take_call(const struct reading *reading, const struct argument_row *row,
                     const char *text)
{
    char error[512] = "";

    return row->take(reading->settings, text, error, sizeof error) ? refuse(reading, row, error)
                                                                   : -1;
}

/* Returns -1 to go on, or an exit status, as all that take something do. */
static int take_option(const struct reading *reading, const struct argument_row *row,
                       const char *text)
{
    void *place = (char *)reading->settings + row->offset;

    switch (row->type) {
    case ARGUMENT_TYPE_ON:
    case ARGUMENT_TYPE_OFF:
        *(bool *)place = row->type == ARGUMENT_TYPE_ON;
        return -1;
    case ARGUMENT_TYPE_TEXT:
        *(const char **)place = text;
        return -1;
    case ARGUMENT_TYPE_PAIR:
        return take_pair(reading, row, text, place);
    case ARGUMENT_TYPE_LIST:
        return take_listed(reading, row, text, place);
    case ARGUMENT_TYPE_INT:
    case ARGUMENT_TYPE_INT64:
        return take_whole(reading, row, text, place);
    case ARGUMENT_TYPE_SECONDS:
        return take_seconds(reading, row, text, place);
    case ARGUMENT_TYPE_CALL:
        return take_call(reading, row, text);
    case ARGUMENT_TYPE_OPTIONS:
        reading->line->print_options(stdout);
        return 0;
    case ARGUMENT_TYPE_HELP:
        print_help(reading);
        return 0;
    case ARGUMENT_TYPE_VERSION:
        printf("%s %s\n", reading->line->program, reach_version);
        return 0;
    }
    return WRONG_USAGE;
}

/* "-50" is a number, not an option. */
static bool is_word(const char *text)
{
    char *end;

    strtod(text, &end);
    return text[0] != '-' || text[1] == '\0' || *end == '\0';
}

static int take_word(const struct reading *reading, const char *text)
{
    const struct argument_row *last = reading->last;
    const size_t length = last && last->value ? strlen(last->value) : 0;
    char error[512] = "";

    if (length > 4 && strcmp(last->value + length - 4, " ...") == 0)
        return take_option(reading, last, text);
    if (!reading->line->take_word)
        return command_line_wrong(reading->line, "unexpected word '%s'", text);
    return reading->line->take_word(reading->settings, text, error, sizeof error)
               ? command_line_wrong(reading->line, "%s", error)
               : -1;
}

/* What getopt did not understand. */
static int refuse_option(const struct reading *reading, int code)
{
    const struct argument_row *row = row_of(reading, optopt);

    if (row && code == ':')
        return command_line_wrong(reading->line, "--%s: %s is missing", row->name, row->value);
    if (row)
        return refuse(reading, row, "takes no value");
    if (optopt)
        return command_line_wrong(reading->line, "unrecognized option '-%c'", optopt);
    return command_line_wrong(reading->line, "unrecognized option '%s'", reading->argv[optind - 1]);
}

int command_line_parse(const struct command_line *line, int argc, char **argv, void *settings)
{
    struct reading reading = {.line = line, .settings = settings, .argv = argv};
    bool only_words = false; /* after "--" */
    int status = -1;

    add_rows(&reading);
    opterr = optind = 0;
    getopt_long(1, argv, reading.letters, reading.words, NULL); /* forgets another command line */
    while (status < 0 && optind < argc) {
        if (only_words || is_word(argv[optind])) {
            status = take_word(&reading, argv[optind++]);
            continue;
        }
        const int code = getopt_long(argc, argv, reading.letters, reading.words, NULL);
        if (code == -1)
            only_words = true;
        else if (code == '?' || code == ':')
            status = refuse_option(&reading, code);
        else
            status = take_option(&reading, reading.last = row_of(&reading, code), optarg);
    }
    return status;
}
