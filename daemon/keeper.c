#include "keeper.h"

#include "realtime.h"

#include "common/bus.h"

#include <time.h>

static const long period_ns = 20000000;

static void *keep(void *user)
{
    const struct timespec period = {.tv_nsec = period_ns};
    struct keeper *keeper = user;

    pthread_setname_np(pthread_self(), "reachd-keeper");
    while (!atomic_load_explicit(&keeper->ending, memory_order_acquire)) {
        model_store_serve(keeper->store, bus_monotonic_us());
        nanosleep(&period, NULL);
    }
    return NULL;
}

int keeper_start(struct keeper *keeper, struct model_store *store, char *error, size_t error_size)
{
    keeper->store = store;
    return realtime_thread(&keeper->thread, 0, keep, keeper, error, error_size);
}

void keeper_stop(struct keeper *keeper)
{
    atomic_store_explicit(&keeper->ending, true, memory_order_release);
    pthread_join(keeper->thread, NULL);
}
