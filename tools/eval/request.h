/* What the command line of reach-eval asks for. */
#ifndef REACH_EVAL_REQUEST_H
#define REACH_EVAL_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

#include "learner/learner.h"

enum {
    REQUEST_MOST = 64,         /* configuration files, parameters */
    REQUEST_MOST_COUNTS = 512, /* of --at: a curve wants many */
};

/* A file to be predicted, under the name that the report gives it. */
struct request_set {
    char name[64];
    const char *path;
    bool is_track;
};

/* Texts are those of argv; what `train` and `sets` point to belongs to the request. */
struct request {
    enum learner_kind kind;
    bool has_kind;
    int n_inputs;
    int n_outputs;
    int n_files; /* of configuration */
    const char *files[REQUEST_MOST];
    int n_params;
    const char *params[REQUEST_MOST];
    int n_train, train_room;
    char **train;
    int n_at; /* 0: after all samples */
    size_t at[REQUEST_MOST_COUNTS];
    int n_sets, sets_room;
    struct request_set *sets;
    const char *json; /* path, or "-" for standard output */
    const char *rows; /* path for the predictions of each row, or NULL */
    const char *save; /* or NULL */
    const char *load; /* or NULL */
    bool quiet;
    bool keeps_frozen;
    bool lists_options;
};

/* Reads the command line. Returns -1 to go on, or an exit status, all having been said. */
int request_read(int argc, char **argv, struct request *request);

void request_free(struct request *request);

/* "imle" and so on. */
const char *request_learner_name(enum learner_kind kind);

#endif
