#include "daemon/threads.h"

#include "common/program/log.h"

static const double loop_patience =
    2; /* s; far more than a tick takes, or a standstill to be seen */
static const double rest_patience = 3; /* s; to brake from the greatest velocity */

static void stop_bus_and_loop(struct threads *threads)
{
    loop_stop(threads->loop, loop_patience);
    daemon_bus_stop(threads->bus);
}

int threads_start(struct threads *threads, char *error, size_t error_size)
{
    if (daemon_bus_start(threads->bus, threads->real_time, error, error_size))
        return -1;
    if (loop_start(threads->loop, error, error_size)) {
        daemon_bus_stop(threads->bus);
        return -1;
    }
    if (watchdog_start(threads->watchdog, threads->real_time, error, error_size)) {
        stop_bus_and_loop(threads);
        return -1;
    }
    if (threads->real_time)
        model_store_unlock_memory(threads->store);
    if (disk_thread_start(&threads->disk, threads->store, error, error_size) == 0)
        return 0;
    loop_stop(threads->loop, loop_patience);
    watchdog_stop(threads->watchdog);
    daemon_bus_stop(threads->bus);
    return -1;
}

bool threads_stop(struct threads *threads)
{
    bool ended = loop_stop(threads->loop, loop_patience);

    if (!ended) {
        log_error("the loop stands still and does not end; the watchdog brakes the arm");
        if (!watchdog_await_rest(threads->watchdog, rest_patience))
            log_error("nobody knows whether the arm rests");
    }
    watchdog_stop(threads->watchdog);
    daemon_bus_stop(threads->bus);
    disk_thread_stop(&threads->disk);
    return ended;
}
