#include "tools/eval/csv.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    LONGEST_LINE = 65536,
    MOST_COLUMNS = 256, /* 16 inputs, 8 outputs, 128 of a Jacobian */
    LONGEST_SHOWN = 24, /* of a cell that is no number */
};

struct reader {
    const char *path;
    gzFile file;
    size_t line; /* the one read last, from 1 */
    char text[LONGEST_LINE];
    const char *separator; /* of the line, in words, where it is no comma; or NULL */
    double row[MOST_COLUMNS];
    size_t room; /* rows that `table` has memory for */
    struct csv_table *table;
    char *error;
    size_t error_size;
};

static int fail(struct reader *reader, const char *reason)
{
    snprintf(reader->error, reader->error_size, "%s:%zu: %s", reader->path, reader->line, reason);
    return -1;
}

/* What zlib or the system says of a file that cannot be read on. */
static int fail_reading(struct reader *reader)
{
    int code;
    const char *reason = gzerror(reader->file, &code);

    reader->line++;
    if (code == Z_ERRNO)
        reason = strerror(errno);
    else if (code == Z_BUF_ERROR)
        reason = "the compressed file is cut short";
    else if (code == Z_DATA_ERROR)
        reason = "the compressed file is damaged";
    return fail(reader, reason);
}

/* The next line without its end. Returns 1, 0 at the end of the file, or -1. */
static int next_line(struct reader *reader)
{
    int code;

    if (!gzgets(reader->file, reader->text, LONGEST_LINE)) {
        gzerror(reader->file, &code);
        return code == Z_OK || code == Z_STREAM_END ? 0 : fail_reading(reader);
    }
    reader->line++;
    size_t length = strlen(reader->text);
    if (length == LONGEST_LINE - 1)
        return fail(reader, "the line is too long for a row of numbers");
    if ((length == 0 || reader->text[length - 1] != '\n') && !gzeof(reader->file))
        return fail(reader, "the line holds a zero byte");
    while (length > 0 && strchr("\r\n", reader->text[length - 1]))
        reader->text[--length] = '\0';
    return 1;
}

/* What separates the cells of a line instead of commas, or NULL. A comma in a line with semicolons
 * is the decimal sign of some countries. */
static const char *foreign_separator(const char *text)
{
    text += strspn(text, " \t");
    if (strchr(text, ';'))
        return "a semicolon";
    if (strchr(text, ','))
        return NULL;
    if (strchr(text, '\t'))
        return "a tab";
    const char *space = strchr(text, ' ');
    return space && space[strspn(space, " ")] ? "a space" : NULL;
}

/* Cuts the line at its commas. Returns the number of cells, at most MOST_COLUMNS + 1. */
static int split(char *text, char *cells[MOST_COLUMNS])
{
    int n = 0;

    for (;;) {
        char *comma = strchr(text, ',');
        if (n == MOST_COLUMNS)
            return n + 1;
        cells[n++] = text;
        if (!comma)
            return n;
        *comma = '\0';
        text = comma + 1;
    }
}

static bool is_number(const char *cell, double *value)
{
    char *end;

    *value = strtod(cell, &end);
    if (end == cell)
        return false;
    return end[strspn(end, " \t")] == '\0';
}

static int fail_separator(struct reader *reader)
{
    char reason[80];

    snprintf(reason, sizeof reason, "the separator is %s; wanted: a comma, and decimal points",
             reader->separator);
    return fail(reader, reason);
}

static int fail_cell(struct reader *reader, int column, const char *cell)
{
    char reason[LONGEST_SHOWN + 80];

    if (reader->separator)
        return fail_separator(reader);
    snprintf(reason, sizeof reason, "column %d: '%.*s' is not a finite number", column + 1,
             LONGEST_SHOWN, cell);
    return fail(reader, reason);
}

/* The width of the table is that of its first line. */
static int take_width(struct reader *reader, int n_cells)
{
    struct csv_table *table = reader->table;
    int least = table->n_inputs + table->n_outputs;
    int most = least + table->n_inputs * table->n_outputs;
    char reason[160];

    if (n_cells != least && n_cells != most) {
        if (reader->separator)
            return fail_separator(reader);
        snprintf(reason, sizeof reason,
                 "%d columns%s; wanted: %d (%d inputs, %d outputs), or %d with the Jacobian",
                 n_cells > MOST_COLUMNS ? MOST_COLUMNS : n_cells,
                 n_cells > MOST_COLUMNS ? " or more" : "", least, table->n_inputs, table->n_outputs,
                 most);
        return fail(reader, reason);
    }
    table->n_columns = n_cells;
    table->has_jacobian = n_cells == most;
    return 0;
}

/* Names instead of numbers, in every column. */
static bool is_header(int n_cells, char *const *cells)
{
    double ignored;

    for (int i = 0; i < n_cells; i++)
        if (is_number(cells[i], &ignored))
            return false;
    return true;
}

static int keep_names(struct reader *reader, char *const *cells)
{
    struct csv_table *table = reader->table;

    table->names = calloc((size_t)table->n_columns, sizeof *table->names);
    if (!table->names)
        return fail(reader, "out of memory");
    for (int i = 0; i < table->n_columns; i++) {
        snprintf(table->names[i], CSV_NAME, "%s", cells[i]);
        for (char *c = table->names[i]; *c; c++)
            if (*c < ' ' || *c > '~') /* a terminal may not obey what a file holds */
                *c = '?';
    }
    return 0;
}

static int append(struct reader *reader)
{
    struct csv_table *table = reader->table;
    size_t width = (size_t)table->n_columns * sizeof(double);

    if (table->n_rows == reader->room) {
        size_t room = reader->room ? 2 * reader->room : 1024;
        double *cells = realloc(table->cells, room * width);
        if (!cells)
            return fail(reader, "out of memory");
        table->cells = cells;
        reader->room = room;
    }
    memcpy(table->cells + table->n_rows * (size_t)table->n_columns, reader->row, width);
    table->n_rows++;
    return 0;
}

static int take_row(struct reader *reader, int n_cells, char *const *cells)
{
    char reason[80];

    if (n_cells != reader->table->n_columns && reader->separator)
        return fail_separator(reader);
    if (n_cells != reader->table->n_columns) {
        snprintf(reason, sizeof reason, "%d columns, the lines before have %d", n_cells,
                 reader->table->n_columns);
        return fail(reader, reason);
    }
    for (int i = 0; i < n_cells; i++)
        if (!is_number(cells[i], &reader->row[i]) || !isfinite(reader->row[i]))
            return fail_cell(reader, i, cells[i]);
    return append(reader);
}

static int take_line(struct reader *reader)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf"; /* as spreadsheets write it */
    char *cells[MOST_COLUMNS];
    char *text = reader->text;

    if (reader->line == 1 && strncmp(text, byte_order_mark, 3) == 0)
        text += 3;
    if (text[0] == '\0')
        return fail(reader, "the line is empty");
    reader->separator = foreign_separator(text);
    int n_cells = split(text, cells);
    if (reader->line == 1) {
        if (take_width(reader, n_cells))
            return -1;
        if (is_header(n_cells, cells))
            return keep_names(reader, cells);
    }
    return take_row(reader, n_cells, cells);
}

static int read_lines(struct reader *reader)
{
    int more;

    while ((more = next_line(reader)) > 0)
        if (take_line(reader))
            return -1;
    if (more < 0)
        return -1;
    if (reader->table->n_rows == 0) {
        reader->line++;
        return fail(reader, "no row of numbers");
    }
    return 0;
}

int csv_read(const char *path, int n_inputs, int n_outputs, struct csv_table *table, char *error,
             size_t error_size)
{
    struct reader *reader = calloc(1, sizeof *reader);
    int result = -1;

    *table = (struct csv_table){.n_inputs = n_inputs, .n_outputs = n_outputs};
    if (!reader) {
        snprintf(error, error_size, "%s: out of memory", path);
        return -1;
    }
    *reader =
        (struct reader){.path = path, .table = table, .error = error, .error_size = error_size};
    reader->file = gzopen(path, "rb");
    if (reader->file) {
        result = read_lines(reader);
        gzclose(reader->file);
    } else {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
    }
    free(reader);
    if (result)
        csv_free(table);
    return result;
}

void csv_free(struct csv_table *table)
{
    free(table->cells);
    free(table->names);
    *table = (struct csv_table){0};
}

const double *csv_input(const struct csv_table *table, size_t row)
{
    return table->cells + row * (size_t)table->n_columns;
}

const double *csv_output(const struct csv_table *table, size_t row)
{
    return csv_input(table, row) + table->n_inputs;
}

const double *csv_jacobian(const struct csv_table *table, size_t row)
{
    return csv_output(table, row) + table->n_outputs;
}
