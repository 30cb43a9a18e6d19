#include "daemon/replay/pieces.h"

#include <stdio.h>
#include <stdlib.h>

static int by_stamp(const void *left, const void *right)
{
    const struct piece *a = left, *b = right;

    return (a->stamp > b->stamp) - (a->stamp < b->stamp);
}

/* When the piece begins; one without an event begins first, and nothing comes of it. */
static int read_stamp(struct piece *piece, char *error, size_t error_size)
{
    struct event event;
    char reason[256];
    int result = event_log_next(piece->log, &event, reason, sizeof reason);

    if (result < 0) {
        snprintf(error, error_size, "%s: %s", piece->path, reason);
        return -1;
    }
    piece->stamp = result > 0 ? event.stamp : INT64_MIN;
    event_log_rewind(piece->log);
    return 0;
}

int pieces_open(struct pieces *pieces, const char *const *paths, int n, char *error,
                size_t error_size)
{
    for (int i = 0; i < n; i++) {
        struct piece *piece = &pieces->piece[i];
        piece->path = paths[i];
        piece->log = event_log_open(paths[i], EVENT_LOG_KEEP_OURS, error, error_size);
        if (!piece->log)
            return -1;
        pieces->n++;
        if (read_stamp(piece, error, error_size))
            return -1;
    }
    qsort(pieces->piece, (size_t)n, sizeof pieces->piece[0], by_stamp);
    return 0;
}

void pieces_close(struct pieces *pieces)
{
    for (int i = 0; i < pieces->n; i++)
        event_log_close(pieces->piece[i].log);
    pieces->n = 0;
}

void pieces_rewind(struct pieces *pieces)
{
    for (int i = 0; i < pieces->n; i++)
        event_log_rewind(pieces->piece[i].log);
    pieces->at = 0;
    pieces->ended = false;
}

int pieces_next(struct pieces *pieces, struct event *event, char *error, size_t error_size)
{
    int result;

    if (pieces->ended && pieces->at + 1 == pieces->n)
        return 0;
    if (pieces->ended)
        pieces->at++;
    result = event_log_next(pieces->piece[pieces->at].log, event, error, error_size);
    pieces->ended = result == 0;
    return pieces->ended ? PIECES_END_OF_ONE : result;
}

const char *pieces_path(const struct pieces *pieces)
{
    return pieces->piece[pieces->at].path;
}
