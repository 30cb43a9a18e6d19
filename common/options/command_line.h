/* A program's command line as a table: one row an option. --help, --version and --help-options come
 * with it, and so do complaints, which name the option and where to read more. */
#ifndef REACH_COMMON_OPTIONS_COMMAND_LINE_H
#define REACH_COMMON_OPTIONS_COMMAND_LINE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

enum argument_type {
    ARGUMENT_TYPE_ON,      /* bool: becomes true */
    ARGUMENT_TYPE_OFF,     /* bool: becomes false */
    ARGUMENT_TYPE_TEXT,    /* const char *: argv's */
    ARGUMENT_TYPE_PAIR,    /* const char *[2]: two words */
    ARGUMENT_TYPE_LIST,    /* const char *[maximum] and an int that counts them */
    ARGUMENT_TYPE_INT,     /* int from minimum to maximum */
    ARGUMENT_TYPE_INT64,   /* int64_t likewise */
    ARGUMENT_TYPE_SECONDS, /* double, positive */
    ARGUMENT_TYPE_CALL,    /* what `take` makes of it */
    ARGUMENT_TYPE_OPTIONS, /* this and the next two: every program's own, not for tables */
    ARGUMENT_TYPE_HELP,
    ARGUMENT_TYPE_VERSION,
};

/* Puts `text` into `settings`. Returns 0, or -1 with what is wrong in `error`. */
typedef int argument_take_fn(void *settings, const char *text, char *error, size_t error_size);

struct argument_row {
    const char *name;  /* without dashes; NULL ends the table */
    char letter;       /* of the short option, or 0 */
    const char *value; /* as help shows it, or NULL; one that ends in " ..." takes the words that
                        * follow it, too */
    enum argument_type type;
    size_t offset, count_offset; /* in the program's settings */
    int64_t minimum, maximum;
    argument_take_fn *take;
    const char *help; /* one text, wrapped as it is printed */
};

#define ARGUMENT_ROW(...)                                                                          \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }
#define ARGUMENT_ON(name, letter, type, field, help)                                               \
    ARGUMENT_ROW(name, letter, NULL, ARGUMENT_TYPE_ON, offsetof(type, field), 0, 0, 0, NULL, help)
#define ARGUMENT_OFF(name, type, field, help)                                                      \
    ARGUMENT_ROW(name, 0, NULL, ARGUMENT_TYPE_OFF, offsetof(type, field), 0, 0, 0, NULL, help)
#define ARGUMENT_TEXT(name, letter, value, type, field, help)                                      \
    ARGUMENT_ROW(name, letter, value, ARGUMENT_TYPE_TEXT, offsetof(type, field), 0, 0, 0, NULL,    \
                 help)
#define ARGUMENT_PAIR(name, value, type, field, help)                                              \
    ARGUMENT_ROW(name, 0, value, ARGUMENT_TYPE_PAIR, offsetof(type, field), 0, 0, 0, NULL, help)
#define ARGUMENT_LIST(name, letter, value, type, field, count, most, help)                         \
    ARGUMENT_ROW(name, letter, value, ARGUMENT_TYPE_LIST, offsetof(type, field),                   \
                 offsetof(type, count), 0, most, NULL, help)
#define ARGUMENT_INT(name, value, type, field, low, high, help)                                    \
    ARGUMENT_ROW(name, 0, value, ARGUMENT_TYPE_INT, offsetof(type, field), 0, low, high, NULL, help)
#define ARGUMENT_INT64(name, value, type, field, low, high, help)                                  \
    ARGUMENT_ROW(name, 0, value, ARGUMENT_TYPE_INT64, offsetof(type, field), 0, low, high, NULL,   \
                 help)
#define ARGUMENT_SECONDS(name, value, type, field, help)                                           \
    ARGUMENT_ROW(name, 0, value, ARGUMENT_TYPE_SECONDS, offsetof(type, field), 0, 0, 0, NULL, help)
#define ARGUMENT_CALL(name, value, take, help)                                                     \
    ARGUMENT_ROW(name, 0, value, ARGUMENT_TYPE_CALL, 0, 0, 0, 0, take, help)
#define ARGUMENT_END ARGUMENT_ROW(NULL, 0, NULL, ARGUMENT_TYPE_ON, 0, 0, 0, 0, NULL, NULL)

/* Where a program's options come from, as options_load takes them: files, and single ones over
 * them; the strings are the command line's. */
enum { OPTION_SOURCES_PATHS = 8, OPTION_SOURCES_OVERRIDES = 64 };
struct option_sources {
    const char *paths[OPTION_SOURCES_PATHS];
    int n_paths;
    const char *overrides[OPTION_SOURCES_OVERRIDES]; /* NAME=VALUE */
    int n_overrides;
};

/* Members of a struct are no expressions: parentheses around them would not compile.
 * NOLINTBEGIN(bugprone-macro-parentheses) */

/* The rows that fill an option_sources; `example` names a file. */
#define ARGUMENT_SET(type, list, count)                                                            \
    ARGUMENT_LIST("set", 's', "NAME=VALUE", type, list, count, OPTION_SOURCES_OVERRIDES,           \
                  "override one option of it (may be repeated)")
#define ARGUMENT_SOURCES(type, field, example)                                                     \
    ARGUMENT_LIST("config", 'c', "FILE", type, field.paths, field.n_paths, OPTION_SOURCES_PATHS,   \
                  "YAML configuration, such as " example                                           \
                  "; given again, the later file overrides the earlier one"),                      \
        ARGUMENT_SET(type, field.overrides, field.n_overrides)

/* The row of the bus, for programs that include common/bus/open.h. */
#define ARGUMENT_URL(type, field)                                                                  \
    ARGUMENT_TEXT("url", 'u', "URL", type, field,                                                  \
                  "LCM bus (default $LCM_DEFAULT_URL, else " BUS_DEFAULT_URL ")")
/* NOLINTEND(bugprone-macro-parentheses) */

/* Words that belong to no option, such as a command and its own arguments. */
enum { COMMAND_WORDS_MOST = 8 };
struct command_words {
    const char *word[COMMAND_WORDS_MOST]; /* argv's */
    int n;
};

/* For take_word below. Returns 0, or -1 with one line in `error` when there are too many. */
int command_words_take(struct command_words *words, const char *text, char *error,
                       size_t error_size);

struct command_line {
    const char *program;
    const char *usage;               /* how it is called, a line each way */
    const char *about;               /* what it is for */
    const struct argument_row *rows; /* at most 24 */
    const char *exit_status;         /* "0 ..., 1 ..."; 2 is wrong usage everywhere */
    void (*print_options)(FILE *);   /* for --help-options; NULL: there is none */
    void (*print_more)(FILE *);      /* at the end of --help; NULL: nothing */
    argument_take_fn *take_word;     /* a word that belongs to no option; NULL: wrong usage */
};

/* Reads argv into `settings`, which the rows' offsets are in. Returns -1 to go on, or an exit
 * status: 0 when what was asked for has been printed, 2 with one line on stderr. */
int command_line_parse(const struct command_line *line, int argc, char **argv, void *settings);

/* Says what is wrong, and where to read more. Returns 2. */
int command_line_wrong(const struct command_line *line, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#ifdef __cplusplus
}
#endif
#endif
