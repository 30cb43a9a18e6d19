#include "learner/store/disk_thread.h"

#include "common/base/thread.h"

#include "common/bus/open.h"

#include <errno.h>
#include <time.h>

static const int64_t period_us = 20000;

/* Until somebody wakes it, or the period is over. Several calls are one. */
static void rest(struct keeper *keeper)
{
    const int64_t until = bus_monotonic_us() + period_us;
    const struct timespec end = {until / 1000000, until % 1000000 * 1000};

    while (sem_clockwait(&keeper->work, CLOCK_MONOTONIC, &end) && errno == EINTR)
        ;
    while (sem_trywait(&keeper->work) == 0)
        ;
}

static void *keep(void *user)
{
    struct keeper *keeper = user;

    pthread_setname_np(pthread_self(), "reachd-keeper");
    while (!atomic_load_explicit(&keeper->ending, memory_order_acquire)) {
        model_store_serve(keeper->store, bus_monotonic_us());
        if (keeper->looked)
            keeper->looked(keeper->user);
        rest(keeper);
    }
    return NULL;
}

int keeper_start(struct keeper *keeper, struct model_store *store, char *error, size_t error_size)
{
    keeper->store = store;
    sem_init(&keeper->work, 0, 0);
    return thread_start(&keeper->thread, 0, keep, keeper, error, error_size);
}

void keeper_wake(struct keeper *keeper)
{
    sem_post(&keeper->work);
}

void keeper_stop(struct keeper *keeper)
{
    atomic_store_explicit(&keeper->ending, true, memory_order_release);
    keeper_wake(keeper);
    pthread_join(keeper->thread, NULL);
}
