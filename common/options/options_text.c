/* Options as text: their values, and the reference that --help-options prints. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/options/options.h"

/* Whether the text gives the value again, to the last bit. */
static bool gives(const char *text, double factor, double value)
{
    return strtod(text, NULL) * factor == value;
}

/* The shortest of a few texts that is the value, or what is nearest to it. */
static void number_text(double value, double factor, char text[40])
{
    static const int digits[] = {12, 15, 17};
    double number = value / factor;

    for (size_t i = 0; i < sizeof digits / sizeof digits[0]; i++) {
        snprintf(text, 40, "%.*g", digits[i], number);
        if (gives(text, factor, value))
            return;
    }
    /* The division was rounded; the number that people wrote is beside it. */
    for (int side = -1; side <= 1; side += 2) {
        snprintf(text, 40, "%.17g", nextafter(number, side < 0 ? -INFINITY : INFINITY));
        if (gives(text, factor, value))
            return;
    }
    snprintf(text, 40, "%.17g", number);
}

/* Appends the number as people write it, between two marks. */
static void append(const struct option_row *row, const char *before, double value,
                   const char *after, char text[OPTION_TEXT_SIZE])
{
    size_t used = strlen(text);
    size_t room = OPTION_TEXT_SIZE - used;
    char number[40];

    if (isinf(value))
        snprintf(text + used, room, "%s%s.inf%s", before, value > 0 ? "" : "-", after);
    else {
        number_text(value, option_unit_factor(row), number);
        snprintf(text + used, room, "%s%s%s", before, number, after);
    }
}

static void list_text(const struct option_row *row, const struct option_list *list,
                      char text[OPTION_TEXT_SIZE])
{
    bool single = row->type == OPTION_SPREAD && list->n == 1;

    for (int i = 0; i < list->n; i++)
        if (single)
            append(row, "", list->value[i], "", text);
        else
            append(row, i == 0 ? "[" : ", ", list->value[i], i == list->n - 1 ? "]" : "", text);
}

/* Cut where the text is full: names have no default, so that nobody reads this again. */
static void names_text(const char *names, char text[OPTION_TEXT_SIZE])
{
    size_t used = 0;

    while (*names && used + 3 < OPTION_TEXT_SIZE) {
        size_t length = strcspn(names, "\n");
        used += (size_t)snprintf(text + used, OPTION_TEXT_SIZE - used, "%s%.*s", used ? ", " : "[",
                                 (int)length, names);
        names += length + (names[length] == '\n');
    }
    if (used && used + 1 < OPTION_TEXT_SIZE)
        snprintf(text + used, OPTION_TEXT_SIZE - used, "]");
}

static void choice_text(const struct option_row *row, int index, char text[OPTION_TEXT_SIZE])
{
    const char *word = row->choices;

    while (index-- > 0)
        word = strchr(word, '|') + 1;
    snprintf(text, OPTION_TEXT_SIZE, "%.*s", (int)strcspn(word, "|"), word);
}

void option_text(const struct option_row *row, const void *target, char text[OPTION_TEXT_SIZE])
{
    const void *field = (const char *)target + row->offset;

    text[0] = '\0';
    switch (row->type) {
    case OPTION_BOOL:
        snprintf(text, OPTION_TEXT_SIZE, *(const bool *)field ? "true" : "false");
        break;
    case OPTION_INT:
        snprintf(text, OPTION_TEXT_SIZE, "%d", *(const int *)field);
        break;
    case OPTION_NUMBER:
        append(row, "", *(const double *)field, "", text);
        break;
    case OPTION_LIST:
    case OPTION_SPREAD:
        list_text(row, (const struct option_list *)field, text);
        break;
    case OPTION_TEXT:
        snprintf(text, OPTION_TEXT_SIZE, "%s", (const char *)field);
        break;
    case OPTION_NAMES:
        names_text((const char *)field, text);
        break;
    case OPTION_CHOICE:
        choice_text(row, *(const int *)field, text);
        break;
    }
}

static const char *type_text(enum option_type type)
{
    switch (type) {
    case OPTION_BOOL:
        return "true or false";
    case OPTION_INT:
        return "whole number";
    case OPTION_NUMBER:
        return "number";
    case OPTION_LIST:
        return "list of numbers";
    case OPTION_SPREAD:
        return "number, or list of numbers";
    case OPTION_TEXT:
        return "text";
    case OPTION_NAMES:
        return "list of names";
    case OPTION_CHOICE:
        return "word";
    }
    return "";
}

/* What holds where no file names it; empty: it must be given. */
static void default_text(const struct option_row *row, const void *preset,
                         char text[OPTION_TEXT_SIZE])
{
    text[0] = '\0';
    if (row->initial == option_preset)
        option_text(row, preset, text);
    else if (row->initial)
        snprintf(text, OPTION_TEXT_SIZE, "%s", row->initial[0] ? row->initial : "\"\"");
}

void options_print(const struct option_row *table, const void *preset, FILE *out)
{
    char value[OPTION_TEXT_SIZE];

    for (; table->name; table++) {
        default_text(table, preset, value);
        fprintf(out, "%-36s %s\n%-36s ", table->name, table->help, "");
        fprintf(out, "%s, %s%s", type_text(table->type), value[0] ? "default " : "must be given",
                value);
        if (table->unit)
            fprintf(out, ", unit %s", table->unit);
        if (table->choices)
            fprintf(out, ", one of %s", table->choices);
        if (table->minimum != 0 || table->maximum != 0)
            fprintf(out, ", range %g .. %g", table->minimum, table->maximum);
        fputc('\n', out);
    }
}
