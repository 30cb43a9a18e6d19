/* The thread that keeps the model on disk. It alone waits for the disk, so that signals are
 * answered and the service manager hears of us while a write takes long or hangs. */
#ifndef REACH_KEEPER_H
#define REACH_KEEPER_H

#include "model_store.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

struct keeper {
    struct model_store *store;
    pthread_t thread;
    _Atomic bool ending;
};

/* Returns 0, or -1 with one line in `error`. */
int keeper_start(struct keeper *keeper, struct model_store *store, char *error, size_t error_size);

/* Ends the thread after what it is at; the store may then be closed. */
void keeper_stop(struct keeper *keeper);

#endif
