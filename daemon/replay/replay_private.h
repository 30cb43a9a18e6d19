/* The replay's state, for the files that make it up: replay.c (messages in, ticks out), which calls
 * run.c (the beginning of a run: configuration and model) and verify.c (what ticks sent); and
 * report.c (what went wrong), which all of them call. */
#ifndef REACH_DAEMON_REPLAY_REPLAY_PRIVATE_H
#define REACH_DAEMON_REPLAY_REPLAY_PRIVATE_H

#include "daemon/bus/incoming.h"
#include "daemon/bus/outgoing.h"
#include "daemon/config/text.h"
#include "daemon/replay/recorded_store.h"
#include "daemon/replay/recording.h"
#include "daemon/replay/replay.h"
#include "learner/bus/body_answer.h"

enum { REPLAY_CONFIGS = 64, REPLAY_BODIES = 8, REPLAY_REASON = 400, REPLAY_NEWEST = 16 };

/* Messages that come on a channel of ours and have another fingerprint. */
struct replay_foreign {
    bool any;         /* of traces: since the newest one of ours */
    int64_t position; /* of the newest */
};

struct replay_trace_id {
    int64_t seq;
    int32_t checksum;
};

/* What was seen of traces. */
struct replay_traces {
    struct replay_trace_id newest[REPLAY_NEWEST];
    int64_t n;
    bool worked; /* in this run a tick was given something that matters */
};

struct replay {
    struct replay_settings settings;
    struct replay_report report;
    struct recording recording[REPLAY_TRACE]; /* of all channels before it */
    reach_config_t texts[REPLAY_CONFIGS];     /* newest configurations */
    int64_t n_texts;
    struct replay_foreign foreign[2]; /* traces, configurations */
    struct replay_traces traces;
    struct received_body bodies[REPLAY_BODIES]; /* newest that were found */
    int64_t n_bodies;

    /* The run. */
    struct arena *arena;
    struct tick *tick;       /* NULL = none has begun */
    struct config config[2]; /* used in turn, so that the tick can go over from one to the other */
    const struct config *used;
    struct recorded_store store;
    int64_t seq; /* of the newest tick */

    /* The tick at hand. */
    int64_t position; /* of its trace */
    reach_trace_t trace;
    struct tick_inputs inputs;
    struct tick_outputs outputs;
    struct outgoing recorded, replayed;
};

/* "byte 123: tick 7: ..." in `error`. Returns -1. */
int replay_fail(const struct replay *replay, char *error, size_t error_size, const char *format,
                ...) __attribute__((format(printf, 4, 5)));

/* Counts `n` messages that are missing, from number `first` on; without `lossy` this is an error.
 * Returns 0, or -1 with one line. */
int replay_miss(struct replay *replay, enum replay_channel channel, int64_t first, int64_t n,
                const char *what, char *error, size_t error_size);

/* traces.c. Whether the trace at hand was logged twice; it is counted, or noted. */
bool replay_is_repeated(struct replay *replay);

/* Whether the trace at hand is the first of a run. */
bool replay_begins_run(struct replay *replay);

/* A trace or a configuration has another fingerprint. */
void replay_note_foreign(struct replay *replay, enum replay_channel channel, int64_t position);

/* Says so of the newest such message. Returns -1. */
int replay_another_version(const struct replay *replay, enum replay_channel channel, char *error,
                           size_t error_size);

/* A tick as it was before the trace at hand, the first of a run. Returns 0, or -1 with one line. */
int replay_begin_run(struct replay *replay, char *error, size_t error_size);

/* The configuration that the trace at hand names becomes the next one in `inputs`, when it is not
 * the one in use. Returns 0, or -1 with one line. */
int replay_follow_config(struct replay *replay, char *error, size_t error_size);

/* What the store said in the tick at hand; with the model, where it was loaded. Returns as above.
 */
int replay_follow_store(struct replay *replay, char *error, size_t error_size);

/* A message of reach-finder's: what was found is kept. */
void replay_take_body(struct replay *replay, const void *data, size_t size);

/* The body that the learner was given in the tick at hand, for the store to give. Returns as above.
 */
int replay_follow_body(struct replay *replay, char *error, size_t error_size);

/* Compares what the tick sends with what it sent. Returns as above. */
int replay_verify(struct replay *replay, char *error, size_t error_size);

#endif
