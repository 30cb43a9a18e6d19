/* What is in a log, counted while it is read once. */
#ifndef REACH_TOOLS_LOG_SURVEY_H
#define REACH_TOOLS_LOG_SURVEY_H

#include "common/bus/message_types.h"
#include "common/logs/event_log.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SURVEY_GAPS = 1000 };

struct survey_channel {
    char *name;
    const struct message_type *type; /* of the first message; NULL = none of ours */
    uint64_t fingerprint;            /* of the first message, 0 = it is too short for one */
    bool mixed;                      /* there are messages of other types, too */
    int64_t messages, bytes;
    int64_t first, last; /* stamps, us since the epoch */
    int64_t pause;       /* the longest between two stamps, us */
    int64_t seq;         /* of the newest message */
    int64_t restarts;    /* how often seq began anew */
};

/* Bytes that are no event. */
struct survey_gap {
    int64_t position, size;
};

/* All zero is an empty one. */
struct survey {
    struct survey_channel *channel; /* in the order of their names */
    size_t n_channels, room;
    int64_t events, bytes; /* `bytes`: of the file */
    int64_t first, last;   /* least and greatest stamp, us since the epoch */
    int64_t newest;        /* stamp of the newest event */
    int64_t turned_back;   /* how often a stamp was less than the one before it */
    int64_t gaps, skipped; /* places that are no event, and their bytes */
    struct survey_gap gap[SURVEY_GAPS];
    bool torn; /* the last gap reaches to the end of the file */
};

/* Counts the rest of the log. Returns 0, or -1 with one line in `error`. */
int survey_read(struct survey *survey, struct event_log *log, char *error, size_t error_size);
void survey_free(struct survey *survey);

/* Runs of the daemon, by the numbers of its ticks; 0 = nothing of it was logged. */
int64_t survey_runs(const struct survey *survey);

#endif
