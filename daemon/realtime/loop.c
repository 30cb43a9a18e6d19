#include "daemon/realtime/loop_private.h"

#include "common/base/thread.h"
#include "daemon/realtime/confine.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

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
    loop->config = config;
    loop->tick = tick;
    loop->bus = bus;
    loop->watchdog = watchdog;
    loop->lockstep = lockstep;
    loop->real_time = real_time;
    return loop;
}

int64_t loop_ticks(const struct loop *loop)
{
    return atomic_load_explicit(&loop->ticks, memory_order_relaxed);
}

struct loop_state loop_state(const struct loop *loop)
{
    int both = atomic_load_explicit(&loop->state, memory_order_relaxed);

    return (struct loop_state){.state = (int8_t)(both / 256), .fault = (int8_t)(both % 256)};
}

enum loop_wait loop_waits(const struct loop *loop)
{
    return (enum loop_wait)atomic_load_explicit(&loop->waits, memory_order_relaxed);
}

const struct config *loop_offer_config(struct loop *loop, const struct config *config)
{
    return atomic_exchange_explicit(&loop->offered, config, memory_order_acq_rel);
}

void loop_take_requests(struct loop *loop)
{
    struct tick_inputs *inputs = &loop->inputs;

    struct received_request received;

    inputs->n_requests = 0;
    while (inputs->n_requests < TICK_MAX_REQUESTS &&
           mailbox_take(daemon_bus_requests(loop->bus), &received)) {
        inputs->request[inputs->n_requests] = received.request;
        inputs->request_checksum[inputs->n_requests++] = received.checksum;
    }
}

void loop_decide(struct loop *loop, int64_t now)
{
    loop->inputs.config = loop_offer_config(loop, NULL);
    if (loop->inputs.config)
        loop->config = loop->inputs.config;
    loop->inputs.emergency = daemon_bus_take_emergency(loop->bus);
    loop->inputs.braked = watchdog_take_braked(loop->watchdog);
    tick_decide(loop->tick, &loop->inputs, now, &loop->outputs);
    if (loop->outputs.has_command)
        daemon_bus_send_command(loop->bus, &loop->outputs.command);
    watchdog_feed(loop->watchdog, loop->outputs.has_command ? &loop->outputs.command : NULL);
    if (loop->outputs.has_sample)
        daemon_bus_send_sample(loop->bus, &loop->outputs.sample);
}

void loop_report(struct loop *loop, int64_t now)
{
    reach_status_t *status = &loop->outputs.status;

    tick_report(loop->tick, now, &loop->outputs);
    status->compute_us = loop->compute.last;
    status->compute_mean_us = timing_mean(&loop->compute);
    status->compute_p999_us = timing_quantile(&loop->compute, 0.999);
    status->compute_max_us = loop->compute.max;
    status->wakeup_us = loop->wakeup.last;
    status->wakeup_mean_us = timing_mean(&loop->wakeup);
    status->wakeup_p999_us = timing_quantile(&loop->wakeup, 0.999);
    status->wakeup_max_us = loop->wakeup.max;
    status->page_faults = realtime_page_faults() - loop->page_faults;
    status->overruns = loop->overruns;
    status->slips = loop->slips;
    loop->outputs.trace.refused = daemon_bus_refused(loop->bus) + loop->bad_states;
    status->bad_inputs += loop->outputs.trace.refused;
    daemon_bus_send_report(loop->bus, status, &loop->outputs.trace);
    atomic_store_explicit(&loop->state, status->state * 256 + status->fault, memory_order_relaxed);
    atomic_fetch_add_explicit(&loop->ticks, 1, memory_order_relaxed);
}

/* The robot must not go on with the last velocity when nobody steers it any more. */
static void send_rest(struct loop *loop)
{
    if (!loop->outputs.has_command)
        return;
    memset(loop->outputs.command.velocity, 0, sizeof loop->outputs.command.velocity);
    daemon_bus_send_command(loop->bus, &loop->outputs.command);
}

/* From here on the thread asks the system for nothing that is not in confine.c. */
static int enter(struct loop *loop)
{
    if (loop->real_time &&
        realtime_enter(REALTIME_PRIORITY_LOOP, loop->start_error, sizeof loop->start_error))
        return -1;
    realtime_touch_stack();
    if (confine_thread(loop->start_error, sizeof loop->start_error))
        return -1;
    loop->page_faults = realtime_page_faults();
    return 0;
}

static void *run(void *user)
{
    struct loop *loop = user;

    pthread_setname_np(pthread_self(), "reachd-loop");
    loop->start_result = enter(loop);
    sem_post(&loop->started);
    if (loop->start_result)
        return NULL;
    if (loop->lockstep)
        loop_run_lockstep(loop);
    else
        loop_run_real_time(loop);
    send_rest(loop);
    return NULL;
}

int loop_start(struct loop *loop, char *error, size_t error_size)
{
    if (sem_init(&loop->started, 0, 0)) {
        snprintf(error, error_size, "%s", strerror(errno));
        return -1;
    }
    if (loop->real_time && realtime_lock_memory(error, error_size))
        return -1;
    if (realtime_thread(&loop->thread, 0, run, loop, error, error_size))
        return -1;
    while (sem_wait(&loop->started) && errno == EINTR)
        ;
    if (loop->start_result) {
        pthread_join(loop->thread, NULL);
        snprintf(error, error_size, "%s", loop->start_error);
    }
    return loop->start_result;
}

void loop_stop(struct loop *loop)
{
    atomic_store_explicit(&loop->ending, true, memory_order_relaxed);
    pthread_join(loop->thread, NULL);
}
