#include "learner/store/disk_thread.h"

#include "common/base/thread.h"

#include "common/bus/open.h"

#include <errno.h>
#include <time.h>

static const int64_t period_us = 20000;

/* Until somebody wakes it, or the period is over. Several calls are one. */
static void rest_until_work(struct disk_thread *disk)
{
    const int64_t until = bus_monotonic_us() + period_us;
    const struct timespec end = {until / 1000000, until % 1000000 * 1000};

    while (sem_clockwait(&disk->work, CLOCK_MONOTONIC, &end) && errno == EINTR)
        ;
    while (sem_trywait(&disk->work) == 0)
        ;
}

static void *serve_store(void *user)
{
    struct disk_thread *disk = user;

    pthread_setname_np(pthread_self(), "reachd-disk");
    while (!atomic_load_explicit(&disk->ending, memory_order_acquire)) {
        model_store_serve(disk->store, bus_monotonic_us());
        if (disk->looked)
            disk->looked(disk->user);
        rest_until_work(disk);
    }
    return NULL;
}

int disk_thread_start(struct disk_thread *disk, struct model_store *store, char *error,
                      size_t error_size)
{
    disk->store = store;
    sem_init(&disk->work, 0, 0);
    return thread_start(&disk->thread, 0, serve_store, disk, error, error_size);
}

void disk_thread_wake(struct disk_thread *disk)
{
    sem_post(&disk->work);
}

void disk_thread_stop(struct disk_thread *disk)
{
    atomic_store_explicit(&disk->ending, true, memory_order_release);
    disk_thread_wake(disk);
    pthread_join(disk->thread, NULL);
}
