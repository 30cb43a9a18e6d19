/* The predictions of each row as CSV, for people who want to see which rows are wrong. */
#ifndef REACH_EVAL_ROWS_H
#define REACH_EVAL_ROWS_H

#include <stddef.h>

#include "learner/learner.h"
#include "tools/measure/output_file.h"

struct rows {
    struct output_file file;
    int n_outputs;
};

/* One row of a set. Pointers are NULL where there is no such answer: its cells stay empty. */
struct rows_entry {
    const char *set;
    size_t row; /* from 0 */
    const double *truth;
    const struct learner_solution *closest, *single, *followed;
};

/* Begins the file with a line of names. Both return 0, or -1 with "path: reason" in `error`. */
int rows_begin(struct rows *rows, const char *path, int n_outputs, char *error, size_t error_size);
int rows_end(struct rows *rows, char *error, size_t error_size);

/* Adds a row; `rows` may be NULL. */
void rows_add(struct rows *rows, const struct rows_entry *entry,
              const struct learner_prediction *prediction);

#endif
