/* A program's options: one table row each, read from YAML, overridden from the command line.
 *
 * The table is the only place that knows an option's name, unit, default, range and meaning; the
 * manual and `--help-options` are printed from it. Values land in the fields of the program's own
 * struct at the offset that the row names. Nested YAML maps become dotted names:
 *     reach: {gain: 2.0}   is   reach.gain
 * Unknown keys, wrong types, values out of range and doubled keys are errors that name the file,
 * the line and the key. */
#ifndef REACH_COMMON_OPTIONS_OPTIONS_H
#define REACH_COMMON_OPTIONS_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define OPTION_MAX_LIST 16    /* longest list of numbers */
#define OPTION_MAX_TEXT 256   /* longest text, with its terminator */
#define OPTION_MAX_NAMES 4096 /* longest list of names, with its terminator */

enum option_type {
    OPTION_BOOL,   /* field: bool */
    OPTION_INT,    /* field: int */
    OPTION_NUMBER, /* field: double */
    OPTION_LIST,   /* field: struct option_list */
    OPTION_SPREAD, /* field: struct option_list; a single number, n = 1, stands for every entry */
    OPTION_TEXT,   /* field: char[OPTION_MAX_TEXT] */
    OPTION_NAMES,  /* field: char[OPTION_MAX_NAMES], a line each; written as a list, or as one
                    * text that blanks part, for names without blanks */
    OPTION_CHOICE, /* field: int, the index of the word in `choices` */
};

/* A list of numbers; `unit` and range hold for each entry. */
struct option_list {
    int n;
    double value[OPTION_MAX_LIST];
};

/* One option. A unit of "deg" or "deg/s" or "deg/s2" is written in degrees by people and stored in
 * radians; every other unit is stored as written. `initial` is the default, in the text that YAML
 * would hold ("2.0", "[1, 2, 3]"); NULL means that the option must be given, `option_preset` that
 * the struct holds the default before it is loaded. `minimum` and `maximum` are in the unit that
 * people write; both 0 means no range. */
struct option_row {
    const char *name;
    enum option_type type;
    size_t offset;
    const char *unit;
    const char *initial;
    double minimum;
    double maximum;
    const char *help;
    const char *choices; /* OPTION_CHOICE: the words, separated by '|' */
};

/* The `initial` of a row whose default the program puts into the struct itself. */
extern const char option_preset[];

/* Ends a table. */
#define OPTION_END                                                                                 \
    {                                                                                              \
        0                                                                                          \
    }

/* Fills `target` with the table's defaults, then with the YAML files `paths`, a later one over an
 * earlier one, then with `n_overrides` texts "name=value", where a list may be
 * "1,2,3" without brackets. The struct is validated whole: on
 * failure it is unspecified and must not be used. returns 0, or -1 with one line in `error`
 * ("etc/kobian.yaml:12: reach.gain: ..."). */
int options_load(const struct option_row *table, void *target, const char *const *paths,
                 int n_paths, const char *const *overrides, int n_overrides, char *error,
                 size_t error_size);

/* The same for a program that calls its overrides otherwise: errors name `override_option` where
 * those of options_load say "--set". */
int options_load_as(const struct option_row *table, void *target, const char *const *paths,
                    int n_paths, const char *override_option, const char *const *overrides,
                    int n_overrides, char *error, size_t error_size);

/* Prints the table as a reference, two lines an option, of which tools/dev/reference.py makes a
 * page: NAME HELP TYPE, default VALUE | must be given[, unit U][, one of A|B][, range LOW .. HIGH]
 * Defaults of `option_preset` rows are read from `preset`, which may be NULL for a table without
 * them. */
void options_print(const struct option_row *table, const void *preset, FILE *out);

/* The value in `target` as YAML would hold it, to the last bit; a list of none is the empty text.
 */
enum { OPTION_TEXT_SIZE = 512 };
void option_text(const struct option_row *row, const void *target, char text[OPTION_TEXT_SIZE]);

/* What the row's unit multiplies with on its way from people to the struct: radians in a degree. */
double option_unit_factor(const struct option_row *row);

/* The row of this name, or NULL. */
const struct option_row *option_find(const struct option_row *table, const char *name);

/* For options_yaml.c: reads a YAML document and calls `apply` for each leaf.
 *   returns 0, or -1 with "path:line: key: reason" in `error`. */
typedef int option_apply_fn(void *user, const char *name, const char *const *items, int n_items,
                            bool is_list, char *error, size_t error_size);
int options_read_yaml(const char *path, FILE *file, option_apply_fn *apply, void *user, char *error,
                      size_t error_size);

#ifdef __cplusplus
}
#endif
#endif
