/* Tables of numbers from CSV files, plain or gzip, with or without a line of names on top.
 *
 * A row is an input z (d numbers), its output x (D numbers), and, where the file carries it, the
 * Jacobian dx/dz (D x d numbers, row-major). */
#ifndef REACH_EVAL_CSV_H
#define REACH_EVAL_CSV_H

#include <stdbool.h>
#include <stddef.h>

enum { CSV_NAME = 40 }; /* of a column, with its end; longer ones are cut */

struct csv_table {
    size_t n_rows;
    int n_inputs;
    int n_outputs;
    bool has_jacobian;
    int n_columns;
    double *cells;           /* n_rows x n_columns, row-major */
    char (*names)[CSV_NAME]; /* of the columns, printable ASCII; NULL in a file without them */
};

/* Reads a file whose rows have n_inputs + n_outputs numbers, or n_inputs * n_outputs more.
 *   returns 0, and the caller frees the table by csv_free; or -1, with "file:line: reason" in
 *   `error`: a row of another length, a cell that is no finite number, another separator than a
 *   comma, an unreadable or damaged file, no row at all */
int csv_read(const char *path, int n_inputs, int n_outputs, struct csv_table *table, char *error,
             size_t error_size);

void csv_free(struct csv_table *table);

/* The parts of a row; row < n_rows. csv_jacobian only where has_jacobian. */
const double *csv_input(const struct csv_table *table, size_t row);
const double *csv_output(const struct csv_table *table, size_t row);
const double *csv_jacobian(const struct csv_table *table, size_t row);

#endif
