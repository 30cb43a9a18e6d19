#include "daemon/bus/bus.h"

#include "common/base/checksum.h"
#include "common/base/newest.h"
#include "common/base/thread.h"
#include "common/bus/open.h"
#include "common/bus/receiver.h"
#include "daemon/bus/incoming.h"
#include "daemon/bus/outgoing.h"
#include "daemon/config/text.h"
#include "learner/bus/body_answer.h"
#include "learner/bus/finder_channels.h"

#include <errno.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define STATES 64
#define OBSERVATIONS 64
#define REQUESTS 16
#define OUTGOING 256
#define REPORTS 4
#define BODIES 4

static const int config_patience_ms = 100;

struct daemon_bus {
    lcm_t *lcm;
    struct mailbox *states, *observations, *requests, *outgoing, *reports, *bodies;
    struct newest *newest_state; /* of those that found no room: never is the newest one lost */
    int64_t states_come;         /* the receiving thread's */
    int64_t state_taken;         /* the loop thread's: number of the newest taken */
    sem_t arrived;               /* posted for every message that the loop may wait for */
    sem_t to_send;               /* posted for every outgoing message */
    _Atomic bool ending;         /* the sending thread */
    _Atomic bool emergency;
    _Atomic int64_t malformed[REFUSALS_CHANNELS];
    enum space_kind space;
    struct outgoing_messages out; /* the sending thread's */
    struct outgoing sending;      /* likewise */
    struct outgoing filling;      /* the loop thread's */
    reach_config_t config;        /* the sending thread's while it waits, else the main thread's */
    int64_t configs;              /* the main thread's */
    _Atomic bool config_waits;
    struct bus_receiver receiver;
    pthread_t sender;
};

size_t daemon_bus_memory(void)
{
    return arena_footprint(sizeof(struct daemon_bus)) +
           mailbox_memory(sizeof(struct received_state), STATES) +
           newest_memory(sizeof(struct received_state)) +
           mailbox_memory(sizeof(struct observation), OBSERVATIONS) +
           mailbox_memory(sizeof(struct received_request), REQUESTS) +
           mailbox_memory(sizeof(struct outgoing), OUTGOING) +
           mailbox_memory(sizeof(reach_status_t), REPORTS) +
           mailbox_memory(sizeof(struct received_body), BODIES);
}

static void refuse(struct daemon_bus *bus, int channel)
{
    atomic_fetch_add_explicit(&bus->malformed[channel], 1, memory_order_relaxed);
}

static void deliver(struct daemon_bus *bus, struct mailbox *mailbox, const void *record)
{
    if (mailbox_put(mailbox, record))
        sem_post(&bus->arrived);
}

/* A robot may send more states in a period than there is room for; the newest counts. */
static void deliver_state(struct daemon_bus *bus, struct received_state *received)
{
    received->number = ++bus->states_come;
    if (!mailbox_full(bus->states)) {
        deliver(bus, bus->states, received);
        return;
    }
    newest_put(bus->newest_state, received);
    sem_post(&bus->arrived);
}

static void on_state(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    struct received_state received = {.received = bus_monotonic_us()};

    (void)channel;
    received.checksum = checksum_crc32(message->data, message->data_size);
    if (incoming_state(message->data, message->data_size, &received.state))
        deliver_state(bus, &received);
    else
        refuse(bus, REACH_STATUS_T_CHANNEL_STATE);
}

static void on_observation(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    struct observation observation;

    (void)channel;
    if (incoming_observation(bus->space, message->data, message->data_size, &observation))
        deliver(bus, bus->observations, &observation);
    else
        refuse(bus, REACH_STATUS_T_CHANNEL_SENSE);
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    struct received_request received = {.checksum =
                                            checksum_crc32(message->data, message->data_size)};

    (void)channel;
    if (!incoming_request(message->data, message->data_size, &received.request)) {
        refuse(bus, REACH_STATUS_T_CHANNEL_REQUEST);
        return;
    }
    if (received.request.kind == REACH_REQUEST_T_EMERGENCY)
        daemon_bus_raise_emergency(bus);
    deliver(bus, bus->requests, &received);
}

static void on_body(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    struct received_body received;

    (void)channel;
    if (!body_answer_read(message->data, message->data_size, &received))
        refuse(bus, REACH_STATUS_T_CHANNEL_BODY);
    else
        mailbox_put(bus->bodies, &received); /* one that finds no room comes again */
}

static bool create_mailboxes(struct daemon_bus *bus, struct arena *arena)
{
    bus->states = mailbox_create(arena, sizeof(struct received_state), STATES);
    bus->newest_state = newest_create(arena, sizeof(struct received_state));
    bus->observations = mailbox_create(arena, sizeof(struct observation), OBSERVATIONS);
    bus->requests = mailbox_create(arena, sizeof(struct received_request), REQUESTS);
    bus->outgoing = mailbox_create(arena, sizeof(struct outgoing), OUTGOING);
    bus->reports = mailbox_create(arena, sizeof(reach_status_t), REPORTS);
    bus->bodies = mailbox_create(arena, sizeof(struct received_body), BODIES);
    return bus->bodies && bus->states && bus->newest_state && bus->observations && bus->requests &&
           bus->outgoing && bus->reports;
}

struct daemon_bus *daemon_bus_create(lcm_t *lcm, enum space_kind space, struct arena *arena,
                                     char *error, size_t error_size)
{
    struct daemon_bus *bus = arena_alloc(arena, sizeof *bus);

    if (!bus || !create_mailboxes(bus, arena)) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    bus->lcm = lcm;
    bus->space = space;
    outgoing_init(&bus->out, lcm, "");
    if (sem_init(&bus->arrived, 0, 0) || sem_init(&bus->to_send, 0, 0) ||
        !lcm_subscribe(lcm, "ROBOT_STATE", on_state, bus) ||
        !lcm_subscribe(lcm, incoming_sense(space), on_observation, bus) ||
        !lcm_subscribe(lcm, "REACH_REQUEST", on_request, bus) ||
        !lcm_subscribe(lcm, finder_channels[FINDER_ASKED_BY_DAEMON].answer, on_body, bus)) {
        snprintf(error, error_size, "cannot subscribe to the bus");
        return NULL;
    }
    return bus;
}

/* Before a message that was put after it: the first trace of a configuration comes after that. */
static void send_waiting_config(struct daemon_bus *bus)
{
    if (!atomic_load_explicit(&bus->config_waits, memory_order_acquire))
        return;
    reach_config_t_publish(bus->lcm, "REACH_CONFIG", &bus->config);
    atomic_store_explicit(&bus->config_waits, false, memory_order_release);
}

static void *send(void *user)
{
    struct daemon_bus *bus = user;
    bool taken;

    pthread_setname_np(pthread_self(), "reachd-send");
    for (;;) {
        while (sem_wait(&bus->to_send) && errno == EINTR)
            ;
        taken = mailbox_take(bus->outgoing, &bus->sending);
        send_waiting_config(bus);
        if (taken)
            outgoing_publish(&bus->out, &bus->sending);
        else if (atomic_load_explicit(&bus->ending, memory_order_acquire))
            return NULL;
    }
}

int daemon_bus_start(struct daemon_bus *bus, bool real_time, char *error, size_t error_size)
{
    int priority = real_time ? THREAD_PRIORITY_BUS : 0;

    if (bus_receiver_start(&bus->receiver, bus->lcm, "reachd-receive", priority, error, error_size))
        return -1;
    if (thread_start(&bus->sender, priority, send, bus, error, error_size) == 0)
        return 0;
    bus_receiver_stop(&bus->receiver);
    return -1;
}

void daemon_bus_stop(struct daemon_bus *bus)
{
    atomic_store_explicit(&bus->ending, true, memory_order_release);
    sem_post(&bus->to_send);
    pthread_join(bus->sender, NULL);
    bus_receiver_stop(&bus->receiver);
}

bool daemon_bus_take_state(struct daemon_bus *bus, struct received_state *received)
{
    /* What found no room is in order with what did: later ones may have found room again. */
    while (mailbox_take(bus->states, received) || newest_take(bus->newest_state, received))
        if (received->number > bus->state_taken) {
            bus->state_taken = received->number;
            return true;
        }
    return false;
}

struct mailbox *daemon_bus_observations(struct daemon_bus *bus)
{
    return bus->observations;
}

struct mailbox *daemon_bus_requests(struct daemon_bus *bus)
{
    return bus->requests;
}

struct mailbox *daemon_bus_reports(struct daemon_bus *bus)
{
    return bus->reports;
}

struct mailbox *daemon_bus_bodies(struct daemon_bus *bus)
{
    return bus->bodies;
}

bool daemon_bus_wait(struct daemon_bus *bus, int milliseconds)
{
    const int64_t until = bus_monotonic_us() + (int64_t)milliseconds * 1000;
    const struct timespec end = {until / 1000000, until % 1000000 * 1000};

    while (sem_clockwait(&bus->arrived, CLOCK_MONOTONIC, &end))
        if (errno != EINTR)
            return false;
    return true;
}

static void hand_over(struct daemon_bus *bus)
{
    if (mailbox_put(bus->outgoing, &bus->filling))
        sem_post(&bus->to_send);
}

void daemon_bus_send_command(struct daemon_bus *bus, const reach_robot_command_t *command)
{
    bus->filling.kind = OUTGOING_COMMAND;
    bus->filling.command = *command;
    hand_over(bus);
}

void daemon_bus_send_sample(struct daemon_bus *bus, const reach_sample_t *sample)
{
    bus->filling.kind = OUTGOING_SAMPLE;
    bus->filling.sample = *sample;
    hand_over(bus);
}

void daemon_bus_send_report(struct daemon_bus *bus, const reach_status_t *status,
                            const reach_trace_t *trace)
{
    bus->filling.kind = OUTGOING_STATUS;
    bus->filling.status = *status;
    hand_over(bus);
    mailbox_put(bus->reports, status);
    bus->filling.kind = OUTGOING_TRACE;
    bus->filling.trace = *trace;
    hand_over(bus);
}

void daemon_bus_send_config(struct daemon_bus *bus, const struct config *config)
{
    /* The one before is on its way; a sender that stands still holds up nobody. */
    for (int ms = 0; atomic_load_explicit(&bus->config_waits, memory_order_acquire); ms++) {
        if (ms == config_patience_ms)
            return;
        sleep_until((bus_monotonic_us() + 1000) * 1000);
    }
    config_message(config, &bus->config);
    bus->config.seq = ++bus->configs;
    atomic_store_explicit(&bus->config_waits, true, memory_order_release);
    sem_post(&bus->to_send);
}

void daemon_bus_raise_emergency(struct daemon_bus *bus)
{
    atomic_store_explicit(&bus->emergency, true, memory_order_release);
}

bool daemon_bus_take_emergency(struct daemon_bus *bus)
{
    return atomic_exchange_explicit(&bus->emergency, false, memory_order_acq_rel);
}

void daemon_bus_refused(const struct daemon_bus *bus,
                        int64_t count[REFUSALS_CHANNELS][REFUSALS_REASONS])
{
    const struct mailbox *const full[REFUSALS_CHANNELS] = {
        [REACH_STATUS_T_CHANNEL_SENSE] = bus->observations,
        [REACH_STATUS_T_CHANNEL_REQUEST] = bus->requests,
        [REACH_STATUS_T_CHANNEL_OUT] = bus->outgoing,
    };

    memset(count, 0, sizeof(int64_t) * REFUSALS_CHANNELS * REFUSALS_REASONS);
    for (int i = 0; i < REFUSALS_CHANNELS; i++) {
        count[i][REACH_STATUS_T_MALFORMED] =
            atomic_load_explicit(&bus->malformed[i], memory_order_relaxed);
        if (full[i])
            count[i][REACH_STATUS_T_FULL] = (int64_t)mailbox_refused(full[i]);
    }
}
