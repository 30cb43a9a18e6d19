#include "learner/service/bus.h"

#include "common/base/mailbox.h"
#include "common/bus/receiver.h"
#include "learner/bus/body_answer.h"
#include "learner/bus/finder_channels.h"

#include <stdatomic.h>
#include <stdio.h>

#define QUEUE 256 /* requests; a power of two */
#define BODIES 4
#define UNTAKEN 512 /* messages that LCM itself keeps; what comes in one burst */

struct arrival {
    int64_t at; /* us, monotonic */
    reach_learner_request_t request;
};

struct service_bus {
    lcm_t *lcm;
    struct mailbox *requests, *bodies;
    void (*arrived)(void *user);
    void *user;
    _Atomic int64_t malformed;
    struct bus_receiver receiver;
};

size_t service_bus_memory(void)
{
    return arena_footprint(sizeof(struct service_bus)) +
           mailbox_memory(sizeof(struct arrival), QUEUE) +
           mailbox_memory(sizeof(struct received_body), BODIES);
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct service_bus *bus = user;
    struct arrival arrival = {.at = bus_receiver_arrived(&bus->receiver)};
    const int size = (int)message->data_size;

    (void)channel;
    if (reach_learner_request_t_decode(message->data, 0, size, &arrival.request) != size)
        atomic_fetch_add_explicit(&bus->malformed, 1, memory_order_relaxed);
    else if (mailbox_put(bus->requests, &arrival))
        bus->arrived(bus->user);
}

static void on_body(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct service_bus *bus = user;
    struct received_body received;

    (void)channel;
    if (!body_answer_read(message->data, message->data_size, &received))
        atomic_fetch_add_explicit(&bus->malformed, 1, memory_order_relaxed);
    else
        mailbox_put(bus->bodies, &received); /* one that finds no room comes again */
}

static bool subscribe(struct service_bus *bus)
{
    lcm_subscription_t *requests = lcm_subscribe(bus->lcm, "LEARNER_REQUEST", on_request, bus);

    return requests && lcm_subscription_set_queue_capacity(requests, UNTAKEN) == 0 &&
           lcm_subscribe(bus->lcm, finder_channels[FINDER_ASKED_BY_LEARNER].answer, on_body, bus);
}

struct service_bus *service_bus_create(lcm_t *lcm, void (*arrived)(void *user), void *user,
                                       struct arena *arena, char *error, size_t error_size)
{
    struct service_bus *bus = arena_alloc(arena, sizeof *bus);

    if (bus) {
        bus->requests = mailbox_create(arena, sizeof(struct arrival), QUEUE);
        bus->bodies = mailbox_create(arena, sizeof(struct received_body), BODIES);
    }
    if (!bus || !bus->requests || !bus->bodies) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    bus->lcm = lcm;
    bus->arrived = arrived;
    bus->user = user;
    if (!subscribe(bus)) {
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

struct mailbox *service_bus_bodies(struct service_bus *bus)
{
    return bus->bodies;
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
