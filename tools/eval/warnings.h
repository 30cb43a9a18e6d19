/* What a user should know of the data or of what was made of them: a line each, on standard error
 * at once and in the report. */
#ifndef REACH_EVAL_WARNINGS_H
#define REACH_EVAL_WARNINGS_H

#include "learner/health/health.h"
#include "tools/eval/csv.h"
#include "tools/measure/json.h"

enum { WARNINGS_MOST = 32, WARNING_SIZE = 512 };

struct warnings {
    int n;
    char text[WARNINGS_MOST][WARNING_SIZE];
};

/* Of more than WARNINGS_MOST the rest is left out. */
void warnings_add(struct warnings *warnings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Every trouble of the samples that were learned. */
void warnings_of_health(struct warnings *warnings, const struct health *health,
                        const struct learner_statistics *statistics);

/* Inputs of a set that are far from the learner's reference. `health` is of the training samples.
 */
void warnings_of_set(struct warnings *warnings, const struct health *health, const char *path,
                     const struct csv_table *table);

void warnings_to_json(const struct warnings *warnings, struct json *json);

#endif
