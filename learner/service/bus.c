#include "learner/service/bus.h"

#include "common/base/mailbox.h"
#include "common/bus/open.h"
#include "common/bus/receiver.h"

#include <stdatomic.h>
#include <stdio.h>

#define QUEUE 256   /* requests; a power of two */
#define UNTAKEN 512 /* messages that LCM itself keeps; what comes in one burst */

static const int64_t lay_most_us = 60000000; /* a clock that was set says more */

struct arrival {
    int64_t at; /* us, monotonic */
    reach_learner_request_t request;
};

struct service_bus {
    lcm_t *lcm;
    struct mailbox *requests;
    void (*arrived)(void *user);
    void *user;
    _Atomic int64_t malformed;
    struct bus_receiver receiver;
};

size_t service_bus_memory(void)
{
    return arena_footprint(sizeof(struct service_bus)) +
           mailbox_memory(sizeof(struct arrival), QUEUE);
}

/* The kernel says by the wall clock when a message came; this thread may have been held up since.
 */
static int64_t arrived_at(const lcm_recv_buf_t *message)
{
    int64_t lay = bus_utime() - message->recv_utime;

    return bus_monotonic_us() - (lay > 0 && lay < lay_most_us ? lay : 0);
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct service_bus *bus = user;
    struct arrival arrival = {.at = arrived_at(message)};
    const int size = (int)message->data_size;

    (void)channel;
    if (reach_learner_request_t_decode(message->data, 0, size, &arrival.request) != size)
        atomic_fetch_add_explicit(&bus->malformed, 1, memory_order_relaxed);
    else if (mailbox_put(bus->requests, &arrival))
        bus->arrived(bus->user);
}

struct service_bus *service_bus_create(lcm_t *lcm, void (*arrived)(void *user), void *user,
                                       struct arena *arena, char *error, size_t error_size)
{
    struct service_bus *bus = arena_alloc(arena, sizeof *bus);
    lcm_subscription_t *subscription;

    if (bus)
        bus->requests = mailbox_create(arena, sizeof(struct arrival), QUEUE);
    if (!bus || !bus->requests) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    bus->lcm = lcm;
    bus->arrived = arrived;
    bus->user = user;
    subscription = lcm_subscribe(lcm, "LEARNER_REQUEST", on_request, bus);
    if (!subscription || lcm_subscription_set_queue_capacity(subscription, UNTAKEN)) {
        snprintf(error, error_size, "cannot subscribe to the bus");
        return NULL;
    }
    return bus;
}

int service_bus_start(struct service_bus *bus, char *error, size_t error_size)
{
    return bus_receiver_start(&bus->receiver, bus->lcm, "learner-receive", 0, error, error_size);
}

void service_bus_stop(struct service_bus *bus)
{
    bus_receiver_stop(&bus->receiver);
}

bool service_bus_take(struct service_bus *bus, reach_learner_request_t *request, int64_t *arrived)
{
    struct arrival arrival;

    if (!mailbox_take(bus->requests, &arrival))
        return false;
    *request = arrival.request;
    *arrived = arrival.at;
    return true;
}

int64_t service_bus_dropped(const struct service_bus *bus)
{
    return (int64_t)mailbox_refused(bus->requests);
}

int64_t service_bus_malformed(const struct service_bus *bus)
{
    return atomic_load_explicit(&bus->malformed, memory_order_relaxed);
}

void service_bus_send(struct service_bus *bus, enum desk_answer answer,
                      const struct desk_output *output)
{
    if (answer == DESK_REPLY)
        reach_learner_reply_t_publish(bus->lcm, "LEARNER_REPLY", &output->reply);
    else if (answer == DESK_PREDICTION)
        reach_learner_prediction_t_publish(bus->lcm, "LEARNER_PREDICTION", &output->prediction);
}
