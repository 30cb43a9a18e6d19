/* Reads a log of lcm-logger's, event after event. Nothing in it is trusted:
 * LCM's own reader allocates what a length field says, and does not tell where it stands. */
#ifndef REACH_DAEMON_REPLAY_EVENT_LOG_H
#define REACH_DAEMON_REPLAY_EVENT_LOG_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    EVENT_LOG_MOST = 64 * 1024, /* bytes of a message that is kept; all that matter are smaller */
    EVENT_LOG_CHANNEL = 64,     /* of a channel's name, with its terminator */
};

struct event_log {
    FILE *file;       /* the caller's */
    int64_t position; /* of the next event, bytes */
    char channel[EVENT_LOG_CHANNEL];
    unsigned char data[EVENT_LOG_MOST];
};

struct event {
    const char *channel;       /* until the next event, like data */
    const unsigned char *data; /* NULL: larger than EVENT_LOG_MOST, and left out */
    size_t size;
    int64_t position; /* in the log, bytes */
};

/* Returns 1 with the next event, 0 at the end, or -1 with one line in `error` that names the
 * position. */
int event_log_next(struct event_log *log, struct event *event, char *error, size_t error_size);

#endif
