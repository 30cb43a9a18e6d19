/* Reads a log of lcm-logger's, event after event. Nothing in it is trusted, nothing is invented and
 * nothing is left out without a word.
 *
 * What begins with LCM's mark counts as an event when behind it stands the mark of the next one, or
 * the end of the file. Otherwise a length in it is wrong, or the logger was killed in the middle of
 * it; then the next event is looked for from behind its own mark on. All bytes in between are
 * reported. tools/reach/event_log.py reads by the same rules; a test compares the two. */
#ifndef REACH_COMMON_LOGS_EVENT_LOG_H
#define REACH_COMMON_LOGS_EVENT_LOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    EVENT_LOG_HEADER = 28,          /* bytes: mark 4, number 8, time 8, two lengths of 4 */
    EVENT_LOG_CHANNEL = 1000,       /* of a channel's name, with its terminator */
    EVENT_LOG_MESSAGE = 1 << 28,    /* bytes; no message of LCM is larger */
    EVENT_LOG_KEEP_ALL = 1 << 28,   /* for event_log_open */
    EVENT_LOG_KEEP_OURS = 64 * 1024 /* all of our messages but images are smaller */
};

struct event_log;

struct event {
    int64_t number;            /* as its logger counted */
    int64_t stamp;             /* when it was logged; us since the epoch */
    const char *channel;       /* until the next call, like data */
    const unsigned char *data; /* NULL: larger than is kept */
    size_t size;               /* of the message, bytes */
    int64_t position;          /* of its mark, bytes; at the end of the log, the log's size */
    int64_t skipped;           /* bytes directly before `position` that are no event */
};

/* Whether the file is there and begins as a log does. Who writes a file of another kind asks before
 * it replaces one: a log is often all that is left of a run. */
bool event_log_begins(const char *path);

/* Opens a file, or for "-" standard input; what can be read only once, such as a pipe, is copied to
 * an unnamed file first. Messages of more than `keep` bytes are not read. What is written to the
 * file later is not seen.
 * Returns NULL with one line in `error`, which names the file. */
struct event_log *event_log_open(const char *path, size_t keep, char *error, size_t error_size);
void event_log_close(struct event_log *log);

/* From the beginning again; gives back memory until then. */
void event_log_rewind(struct event_log *log);

/* Returns 1 with the next event; 0 at the end, with `position` and `skipped` of *event set; or -1
 * when the file cannot be read, with one line in `error`. */
int event_log_next(struct event_log *log, struct event *event, char *error, size_t error_size);

/* The bytes of the event, from its mark on, or NULL when they are not kept or cannot be read.
 * `size` gets how many they are. Until the next call. */
const unsigned char *event_log_bytes(struct event_log *log, const struct event *event,
                                     size_t *size);

#ifdef __cplusplus
}
#endif
#endif
