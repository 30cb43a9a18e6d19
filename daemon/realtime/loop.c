#include "daemon/realtime/loop.h"

#include "common/base/thread.h"
#include "common/bus/open.h"
#include "daemon/realtime/clock.h"
#include "daemon/realtime/confine.h"
#include "daemon/realtime/step.h"

#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

struct loop {
    struct step step;
    bool lockstep;
    bool real_time;

    pthread_t thread;
    sem_t started;
    int start_result;
    char start_error[200];
};

size_t loop_memory(void)
{
    return arena_footprint(sizeof(struct loop));
}

struct loop *loop_create(const struct config *config, struct tick *tick, struct daemon_bus *bus,
                         struct watchdog *watchdog, bool lockstep, bool real_time,
                         struct arena *arena)
{
    struct loop *loop = arena_alloc(arena, sizeof *loop);

    if (!loop)
        return NULL;
    loop->step.config = config;
    loop->step.tick = tick;
    loop->step.bus = bus;
    loop->step.watchdog = watchdog;
    loop->lockstep = lockstep;
    loop->real_time = real_time;
    return loop;
}

int64_t loop_ticks(const struct loop *loop)
{
    return atomic_load_explicit(&loop->step.ticks, memory_order_relaxed);
}

enum loop_wait loop_waits(const struct loop *loop)
{
    return (enum loop_wait)atomic_load_explicit(&loop->step.waits, memory_order_relaxed);
}

const struct config *loop_offer_config(struct loop *loop, const struct config *config)
{
    return atomic_exchange_explicit(&loop->step.offered, config, memory_order_acq_rel);
}

/* The robot must not go on with the last velocity when nobody steers it any more. */
static void send_rest(struct loop *loop)
{
    if (!loop->step.outputs.has_command)
        return;
    memset(loop->step.outputs.command.velocity, 0, sizeof loop->step.outputs.command.velocity);
    daemon_bus_send_command(loop->step.bus, &loop->step.outputs.command);
}

/* From here on the thread asks the system for nothing that is not in confine.c. */
static int enter_thread(struct loop *loop)
{
    if (loop->real_time &&
        thread_enter(THREAD_PRIORITY_LOOP, loop->start_error, sizeof loop->start_error))
        return -1;
    thread_touch_stack();
    if (confine_thread(loop->lockstep, loop->start_error, sizeof loop->start_error))
        return -1;
    loop->step.page_faults = thread_page_faults();
    return 0;
}

static void *run_loop(void *user)
{
    struct loop *loop = user;

    pthread_setname_np(pthread_self(), "reachd-loop");
    loop->start_result = enter_thread(loop);
    sem_post(&loop->started);
    if (loop->start_result)
        return NULL;
    if (loop->lockstep)
        clock_run_lockstep(&loop->step);
    else
        clock_run_real_time(&loop->step);
    send_rest(loop);
    return NULL;
}

int loop_start(struct loop *loop, char *error, size_t error_size)
{
    if (sem_init(&loop->started, 0, 0)) {
        snprintf(error, error_size, "%s", strerror(errno));
        return -1;
    }
    if (loop->real_time && thread_lock_memory(error, error_size))
        return -1;
    if (thread_start(&loop->thread, 0, run_loop, loop, error, error_size))
        return -1;
    while (sem_wait(&loop->started) && errno == EINTR)
        ;
    if (loop->start_result) {
        pthread_join(loop->thread, NULL);
        snprintf(error, error_size, "%s", loop->start_error);
    }
    return loop->start_result;
}

bool loop_stop(struct loop *loop, double seconds)
{
    int64_t end = bus_monotonic_us() + (int64_t)(seconds * 1e6);
    const struct timespec until = {end / 1000000, end % 1000000 * 1000};

    atomic_store_explicit(&loop->step.ending, true, memory_order_relaxed);
    return pthread_clockjoin_np(loop->thread, NULL, CLOCK_MONOTONIC, &until) == 0;
}
