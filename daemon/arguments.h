/* reachd's command line. */
#ifndef REACH_ARGUMENTS_H
#define REACH_ARGUMENTS_H

#include "common/options/command_line.h"
#include "daemon/replay/pieces.h"

#include <stdbool.h>

enum { MAX_MODELS = 16 };

struct arguments {
    struct option_sources configuration;
    const char *url;
    bool lockstep, no_rt, check_config, check_model, verbose;

    const char *replay[PIECES_MOST]; /* a log, or pieces of one */
    int n_replay;                    /* 0 = none */
    bool replay_clock;               /* what is played on the bus */
    bool verify;
    const char *models[MAX_MODELS];
    int n_models;
};

/* Returns -1 to go on, or an exit status: 0 when what was asked for has been printed, 2 with one
 * line on stderr. */
int arguments_parse(struct arguments *arguments, int argc, char **argv);

#endif
