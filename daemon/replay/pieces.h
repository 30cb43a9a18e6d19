/* A log in one file or in several, as `lcm-logger --split-mb` leaves it: read as one, in the order
 * of the pieces' first stamps. */
#ifndef REACH_DAEMON_REPLAY_PIECES_H
#define REACH_DAEMON_REPLAY_PIECES_H

#include "common/logs/event_log.h"

#include <stdbool.h>
#include <stddef.h>

enum { PIECES_MOST = 256 };

struct piece {
    const char *path; /* the caller's */
    struct event_log *log;
    int64_t stamp; /* of its first event, us since the epoch */
};

/* All zero before pieces_open. */
struct pieces {
    struct piece piece[PIECES_MOST];
    int n;
    int at;     /* the piece that is read */
    bool ended; /* the next one is to be read */
};

/* Opens all of them, in any order. Returns 0, or -1 with one line in `error` that names the file;
 * pieces_close is called either way. */
int pieces_open(struct pieces *pieces, const char *const *paths, int n, char *error,
                size_t error_size);
void pieces_close(struct pieces *pieces);

/* From the beginning again. */
void pieces_rewind(struct pieces *pieces);

/* As event_log_next, but PIECES_END_OF_ONE at the end of each piece, with `position` and `skipped`
 * of *event set; 0 comes after the last. */
enum { PIECES_END_OF_ONE = 2 };
int pieces_next(struct pieces *pieces, struct event *event, char *error, size_t error_size);

/* The file that the last call has read in. */
const char *pieces_path(const struct pieces *pieces);

#endif
