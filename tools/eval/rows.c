#include "tools/eval/rows.h"

#include <math.h>
#include <stdio.h>

static void put_names(struct rows *rows, const char *what)
{
    for (int i = 0; i < rows->n_outputs; i++)
        fprintf(rows->file.stream, ",%s%d", what, i + 1);
}

int rows_begin(struct rows *rows, const char *path, int n_outputs, char *error, size_t error_size)
{
    static const char *const groups[] = {"x",         "closest", "closest_sd",
                                         "strongest", "single",  "followed"};

    rows->n_outputs = n_outputs;
    if (output_begin(&rows->file, path, error, error_size))
        return -1;
    fputs("set,row,solutions", rows->file.stream);
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++)
        put_names(rows, groups[i]);
    fputc('\n', rows->file.stream);
    return 0;
}

int rows_end(struct rows *rows, char *error, size_t error_size)
{
    return output_commit(&rows->file, error, error_size);
}

/* As many cells as there are outputs, empty without numbers. */
static void put_numbers(struct rows *rows, const double *numbers)
{
    for (int i = 0; i < rows->n_outputs; i++)
        if (numbers)
            fprintf(rows->file.stream, ",%.9g", numbers[i]);
        else
            fputc(',', rows->file.stream);
}

static void put_answer(struct rows *rows, const struct learner_solution *answer)
{
    put_numbers(rows, answer ? answer->value : NULL);
}

static void put_deviations(struct rows *rows, const struct learner_solution *answer)
{
    double deviation[LEARNER_MAX_OUTPUTS];

    for (int i = 0; answer && i < rows->n_outputs; i++)
        deviation[i] = sqrt(answer->variance[i]);
    put_numbers(rows, answer ? deviation : NULL);
}

void rows_add(struct rows *rows, const struct rows_entry *entry,
              const struct learner_prediction *prediction)
{
    if (!rows)
        return;
    fprintf(rows->file.stream, "%s,%zu,%d", entry->set, entry->row + 1, prediction->n_solutions);
    put_numbers(rows, entry->truth);
    put_answer(rows, entry->closest);
    put_deviations(rows, entry->closest);
    put_answer(rows, prediction->n_solutions > 0 ? &prediction->solution[0] : NULL);
    put_answer(rows, entry->single);
    put_answer(rows, entry->followed);
    fputc('\n', rows->file.stream);
}
