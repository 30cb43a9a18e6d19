/* The thread that keeps the model on disk. It alone waits for that disk, so that signals are
 * answered and the service manager hears of us while a write takes long or hangs. */
#ifndef REACH_LEARNER_STORE_DISK_THREAD_H
#define REACH_LEARNER_STORE_DISK_THREAD_H

#include "learner/store/store.h"

#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

struct disk_thread {
    struct model_store *store;
    /* Called by the thread after each look at the store, NULL: nobody cares. Set before the start.
     */
    void (*looked)(void *user);
    void *user;
    pthread_t thread;
    sem_t work;
    _Atomic bool ending;
};

/* Returns 0, or -1 with one line in `error`. */
int disk_thread_start(struct disk_thread *disk, struct model_store *store, char *error,
                      size_t error_size);

/* Lets it look at the store at once; it does so every 20 ms anyway. For any thread. */
void disk_thread_wake(struct disk_thread *disk);

/* Ends the thread after what it is at; the store may then be closed. */
void disk_thread_stop(struct disk_thread *disk);

#endif
