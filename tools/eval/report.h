/* What reach-eval found out, as JSON for programs and as a table for people. */
#ifndef REACH_EVAL_REPORT_H
#define REACH_EVAL_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "learner/finder/seeker.h"
#include "tools/eval/request.h"
#include "tools/eval/score.h"
#include "tools/eval/warnings.h"

struct report_set {
    bool is_track;
    struct score_test test;
    struct score_track track;
};

/* The learner after so many samples. */
struct report_result {
    size_t at;
    struct learner_statistics statistics;
    size_t frozen;                     /* samples whose outputs stood still while inputs moved */
    bool has_body;                     /* experts: body; then */
    struct seeker seeker;              /* what was found of it */
    struct learner_body_change change; /* what has changed since */
    bool has_rest;                     /* there is a body; then */
    double not_rigid[LEARNER_MAX_OUTPUTS]; /* what no rigid chain explains */
    struct durations_summary update;       /* of the updates since the result before */
    struct durations_summary predict;      /* of this result's predictions */
    struct report_set *sets;               /* in the order of the request's */
};

struct report {
    const struct request *request;
    const struct learner_config *config;
    size_t memory;                 /* bytes of the learner */
    const struct csv_table *train; /* the request's files */
    const struct warnings *warnings;
    int n_results;
    struct report_result results[REQUEST_MOST_COUNTS];
};

void report_to_json(const struct report *report, FILE *out);

/* One line for each set of one result. */
void report_print(const struct request *request, const struct report_result *result, FILE *out);

#endif
