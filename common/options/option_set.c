#include "common/options/option_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double radians_per_degree = 3.14159265358979323846 / 180.0;

/* The one place where degrees end. */
double option_unit_factor(const struct option_row *row)
{
    return row->unit && strncmp(row->unit, "deg", 3) == 0 ? radians_per_degree : 1.0;
}

static int parse_number(const struct option_row *row, const char *text, double *value, char *error,
                        size_t error_size)
{
    char *end;
    double number;

    if (strcmp(text, ".inf") == 0) /* YAML's infinity */
        text = "inf";
    number = strtod(text, &end);
    if (end == text || *end || isnan(number)) {
        snprintf(error, error_size, "'%s' is not a number", text);
        return -1;
    }
    if ((row->minimum != 0 || row->maximum != 0) &&
        (number < row->minimum || number > row->maximum)) {
        snprintf(error, error_size, "%s is out of range %g .. %g%s%s", text, row->minimum,
                 row->maximum, row->unit ? " " : "", row->unit ? row->unit : "");
        return -1;
    }
    *value = number;
    return 0;
}

static int set_int(const struct option_row *row, int *field, const char *text, char *error,
                   size_t error_size)
{
    double number;

    if (parse_number(row, text, &number, error, error_size))
        return -1;
    if (number != floor(number) || fabs(number) > 2147483647.0) {
        snprintf(error, error_size, "'%s' is not a whole number", text);
        return -1;
    }
    *field = (int)number;
    return 0;
}

static int set_bool(bool *field, const char *text, char *error, size_t error_size)
{
    if (strcmp(text, "true") == 0 || strcmp(text, "yes") == 0) {
        *field = true;
    } else if (strcmp(text, "false") == 0 || strcmp(text, "no") == 0) {
        *field = false;
    } else {
        snprintf(error, error_size, "'%s' is neither true nor false", text);
        return -1;
    }
    return 0;
}

static int set_text(char *field, const char *text, char *error, size_t error_size)
{
    if (strlen(text) >= OPTION_MAX_TEXT) {
        snprintf(error, error_size, "text is longer than %d characters", OPTION_MAX_TEXT - 1);
        return -1;
    }
    memcpy(field, text, strlen(text) + 1);
    return 0;
}

static int add_name(char *field, const char *name, size_t length, char *error, size_t error_size)
{
    size_t used = strlen(field);

    if (length == 0 || memchr(name, '\n', length)) {
        snprintf(error, error_size, "a name is empty or has a line break in it");
        return -1;
    }
    if (used + length + 2 > OPTION_MAX_NAMES) {
        snprintf(error, error_size, "names are longer than %d characters", OPTION_MAX_NAMES - 1);
        return -1;
    }
    if (used)
        field[used++] = '\n';
    memcpy(field + used, name, length);
    field[used + length] = '\0';
    return 0;
}

/* The names of a list as they are, or the words of a text. */
static int set_names(char *field, const char *const *items, int n_items, bool is_list, char *error,
                     size_t error_size)
{
    const char *blanks = " \t\n";

    field[0] = '\0';
    if (is_list) {
        for (int i = 0; i < n_items; i++)
            if (add_name(field, items[i], strlen(items[i]), error, error_size))
                return -1;
        return 0;
    }
    for (const char *word = items[0]; *(word += strspn(word, blanks));) {
        size_t length = strcspn(word, blanks);
        if (add_name(field, word, length, error, error_size))
            return -1;
        word += length;
    }
    return 0;
}

static int set_choice(const struct option_row *row, int *field, const char *text, char *error,
                      size_t error_size)
{
    const char *word = row->choices;
    size_t length = strlen(text);

    for (int index = 0; word; index++) {
        const char *bar = strchr(word, '|');
        size_t word_length = bar ? (size_t)(bar - word) : strlen(word);
        if (word_length == length && strncmp(word, text, length) == 0) {
            *field = index;
            return 0;
        }
        word = bar ? bar + 1 : NULL;
    }
    snprintf(error, error_size, "'%s' is not one of %s", text, row->choices);
    return -1;
}

static int set_list(const struct option_row *row, struct option_list *field,
                    const char *const *items, int n_items, char *error, size_t error_size)
{
    if (n_items > OPTION_MAX_LIST) {
        snprintf(error, error_size, "list is longer than %d", OPTION_MAX_LIST);
        return -1;
    }
    memset(field, 0, sizeof *field);
    for (int i = 0; i < n_items; i++) {
        if (parse_number(row, items[i], &field->value[i], error, error_size))
            return -1;
        field->value[i] *= option_unit_factor(row);
    }
    field->n = n_items;
    return 0;
}

/* Sets one option from the texts of a list, or from the one of a scalar. What is wrong goes to
 * `error` without file and key. */
int option_set(const struct option_row *row, void *target, const char *const *items, int n_items,
               bool is_list, char *error, size_t error_size)
{
    char *field = (char *)target + row->offset;

    if (row->type != OPTION_SPREAD && row->type != OPTION_NAMES &&
        is_list != (row->type == OPTION_LIST)) {
        snprintf(error, error_size,
                 is_list ? "a single value is wanted, not a list" : "a list [a, b, ...] is wanted");
        return -1;
    }
    switch (row->type) {
    case OPTION_BOOL:
        return set_bool((bool *)(void *)field, items[0], error, error_size);
    case OPTION_INT:
        return set_int(row, (int *)(void *)field, items[0], error, error_size);
    case OPTION_NUMBER:
        if (parse_number(row, items[0], (double *)(void *)field, error, error_size))
            return -1;
        *(double *)(void *)field *= option_unit_factor(row);
        return 0;
    case OPTION_LIST:
    case OPTION_SPREAD:
        return set_list(row, (struct option_list *)(void *)field, items, n_items, error,
                        error_size);
    case OPTION_TEXT:
        return set_text(field, items[0], error, error_size);
    case OPTION_NAMES:
        return set_names(field, items, n_items, is_list, error, error_size);
    case OPTION_CHOICE:
        return set_choice(row, (int *)(void *)field, items[0], error, error_size);
    }
    return -1;
}
