#include "learner/service/clients.h"

#include <string.h>

struct client {
    int64_t number;
    int64_t floor;  /* what is numbered up to here is not done any more */
    uint64_t heard; /* when last, on a clock that counts calls; 0 = a free place */
    struct deed deeds[CLIENTS_REMEMBERED];
};

struct clients {
    uint64_t clock;
    struct client client[CLIENTS_MOST];
};

size_t clients_memory(void)
{
    return arena_footprint(sizeof(struct clients));
}

struct clients *clients_create(struct arena *arena)
{
    return arena_alloc(arena, sizeof(struct clients));
}

static struct client *find_client(struct clients *clients, int64_t number)
{
    for (int i = 0; i < CLIENTS_MOST; i++)
        if (clients->client[i].heard && clients->client[i].number == number)
            return &clients->client[i];
    return NULL;
}

/* A free place, or that of who was silent longest. */
static struct client *oldest(struct clients *clients)
{
    struct client *found = &clients->client[0];

    for (int i = 1; i < CLIENTS_MOST; i++)
        if (clients->client[i].heard < found->heard)
            found = &clients->client[i];
    return found;
}

void clients_admit(struct clients *clients, int64_t client, int64_t seq)
{
    struct client *known = find_client(clients, client);

    if (!known) {
        known = oldest(clients);
        memset(known, 0, sizeof *known);
        known->number = client;
        known->floor = seq;
    }
    known->heard = ++clients->clock;
}

enum clients_verdict clients_look(struct clients *clients, int64_t client, int64_t seq,
                                  struct deed **deed)
{
    struct client *known = find_client(clients, client);

    if (!known)
        return CLIENTS_UNKNOWN;
    known->heard = ++clients->clock;
    if (seq <= known->floor)
        return CLIENTS_FORGOTTEN;
    *deed = &known->deeds[(uint64_t)seq % CLIENTS_REMEMBERED];
    if ((*deed)->seq == seq)
        return CLIENTS_REPEATED;
    return (*deed)->seq > seq ? CLIENTS_FORGOTTEN : CLIENTS_NEW;
}
