/* The daemon's decisions anew, from what was recorded of a run: the same tick, driven by its
 * traces.
 *
 * Messages come in the order in which they were recorded, from a log or from the bus. Each
 * REACH_TRACE tells what its tick was given, and the tick is run on that. docs/replay.md. */
#ifndef REACH_DAEMON_REPLAY_REPLAY_H
#define REACH_DAEMON_REPLAY_REPLAY_H

#include "daemon/config/config.h"
#include "daemon/control/tick.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum replay_channel {
    REPLAY_STATE,
    REPLAY_MARKER,
    REPLAY_EFFECTOR,
    REPLAY_REQUEST,
    REPLAY_COMMAND,
    REPLAY_SAMPLE,
    REPLAY_STATUS,
    REPLAY_TRACE,
    REPLAY_CONFIG,
    REPLAY_BODY,
};
enum { REPLAY_CHANNELS = REPLAY_BODY + 1 };

extern const char *const replay_channels[REPLAY_CHANNELS];

struct replay_settings {
    const struct config *config; /* in place of the recorded one; NULL = the recorded one */
    const char *const *models;   /* files of the models that runs began with, or loaded */
    int n_models;
    bool verify;                                           /* compare what ticks sent */
    bool lossy;                                            /* go on after what is missing */
    void (*sink)(void *user, struct tick_outputs *output); /* gets what each tick sends; or NULL */
    void *user;
};

enum { REPLAY_RUNS = 32 };

/* What is missing of one channel. */
struct replay_lost {
    int64_t n;
    int64_t first; /* number of the first */
};

struct replay_run {
    struct replay_lost lost[REPLAY_CHANNELS];
};

struct replay_report {
    int64_t ticks, runs;
    double seconds;                     /* of the robot's time */
    int64_t repeated;                   /* REACH_TRACE that were there twice, and were taken once */
    int64_t foreign;                    /* REACH_TRACE of another layout, which were left out */
    char revision[48];                  /* of the daemon that was recorded; "" = not known */
    struct replay_run run[REPLAY_RUNS]; /* the last holds all runs beyond it, too */
};

struct replay;

/* Returns NULL when there is no memory. `settings` is copied, what it points to is kept. */
struct replay *replay_create(const struct replay_settings *settings);
void replay_destroy(struct replay *replay);

/* The next message; those of channels that do not matter are ignored. `position` is where it is in
 * the log, for errors. Returns 0, or -1 with one line in `error`: it cannot go on, or what was
 * recorded differs from what was computed. */
int replay_take(struct replay *replay, const char *channel, const void *data, size_t size,
                int64_t position, char *error, size_t error_size);

/* There are no more messages. Returns 0, or -1 with one line in `error`: nothing was replayed, or
 * not the last tick. */
int replay_end(const struct replay *replay, char *error, size_t error_size);

const struct replay_report *replay_report(const struct replay *replay);

#endif
