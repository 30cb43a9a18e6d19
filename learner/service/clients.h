/* Who has asked what, so that a request that comes twice is done once.
 *
 * Each client numbers its requests; of what was done for it, the newest is remembered at place
 * seq modulo CLIENTS_REMEMBERED. A place's number only grows, so that whatever the order in which
 * requests come, none is done twice: its place holds it, or a later one, or it was not done.
 * Of more clients than there is room for, the one that was silent longest is forgotten; what it
 * asks after that is refused until it makes itself known again. */
#ifndef REACH_LEARNER_SERVICE_CLIENTS_H
#define REACH_LEARNER_SERVICE_CLIENTS_H

#include "common/base/arena.h"

#include <stddef.h>
#include <stdint.h>

#define CLIENTS_MOST 64
#define CLIENTS_REMEMBERED 64

/* What was done. */
struct deed {
    int64_t seq; /* 0 = nothing yet */
    int64_t sample;
    int8_t kind, learned, status;
    int8_t waits; /* not answered yet */
};

struct clients;

size_t clients_memory(void);

/* Owned by the arena; NULL when it is full. */
struct clients *clients_create(struct arena *arena);

/* Makes a client known, unless it is: requests up to `seq` count as done long ago. */
void clients_admit(struct clients *clients, int64_t client, int64_t seq);

enum clients_verdict {
    CLIENTS_NEW,       /* not done yet: `deed` is its place, to be filled by who does it */
    CLIENTS_REPEATED,  /* done: `deed` says how */
    CLIENTS_FORGOTTEN, /* too long ago to tell */
    CLIENTS_UNKNOWN,   /* nobody knows this client */
};

/* A look at one request of one client; `deed` is good until the next call of clients_admit. */
enum clients_verdict clients_look(struct clients *clients, int64_t client, int64_t seq,
                                  struct deed **deed);

#endif
