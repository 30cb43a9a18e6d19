#include "daemon_bus.h"

#include "common/bus.h"
#include "common/log.h"
#include "observation.h"
#include "realtime.h"

#include <errno.h>
#include <pthread.h>
#include <reach_end_effector_t.h>
#include <reach_marker_t.h>
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

static const int poll_ms = 100; /* how soon the receiving thread sees that it is to end */

enum outgoing_kind { OUTGOING_COMMAND, OUTGOING_SAMPLE, OUTGOING_STATUS, OUTGOING_TRACE };

struct outgoing {
    enum outgoing_kind kind;
    union {
        reach_robot_command_t command;
        reach_sample_t sample;
        reach_status_t status;
        reach_trace_t trace;
    };
};

struct daemon_bus {
    lcm_t *lcm;
    struct mailbox *states, *observations, *requests, *outgoing, *reports;
    sem_t arrived; /* posted for every message that the loop may wait for */
    sem_t to_send; /* posted for every outgoing message */
    _Atomic bool ending;
    _Atomic bool emergency;
    _Atomic int64_t malformed;
    struct outgoing sending; /* the sending thread's */
    struct outgoing filling; /* the loop thread's */
    pthread_t receiver, sender;
};

size_t daemon_bus_memory(void)
{
    return arena_footprint(sizeof(struct daemon_bus)) +
           mailbox_memory(sizeof(struct received_state), STATES) +
           mailbox_memory(sizeof(struct observation), OBSERVATIONS) +
           mailbox_memory(sizeof(reach_request_t), REQUESTS) +
           mailbox_memory(sizeof(struct outgoing), OUTGOING) +
           mailbox_memory(sizeof(reach_status_t), REPORTS);
}

/* Decodes a whole message of a type of fixed size: anything longer or shorter is refused. */
#define DECODE(type, message, value)                                                               \
    (type##_decode((message)->data, 0, (int)(message)->data_size, (value)) ==                      \
     (int)(message)->data_size)

static void refuse(struct daemon_bus *bus)
{
    atomic_fetch_add_explicit(&bus->malformed, 1, memory_order_relaxed);
}

static void deliver(struct daemon_bus *bus, struct mailbox *mailbox, const void *record)
{
    if (mailbox_put(mailbox, record))
        sem_post(&bus->arrived);
}

static void on_state(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    struct received_state received = {.received = bus_monotonic_us()};

    (void)channel;
    if (DECODE(reach_robot_state_t, message, &received.state))
        deliver(bus, bus->states, &received);
    else
        refuse(bus);
}

static void on_marker(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    reach_marker_t marker;

    (void)channel;
    if (!DECODE(reach_marker_t, message, &marker)) {
        refuse(bus);
        return;
    }
    deliver(bus, bus->observations,
            &(struct observation){.utime = marker.utime,
                                  .seq = marker.seq,
                                  .seen = marker.seen,
                                  .value = {marker.u_right, marker.v_right, marker.disparity}});
}

static void on_effector(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    reach_end_effector_t effector;
    struct observation observation = {.seen = 1};

    (void)channel;
    if (!DECODE(reach_end_effector_t, message, &effector)) {
        refuse(bus);
        return;
    }
    observation.utime = effector.utime;
    observation.seq = effector.seq;
    memcpy(observation.value, effector.position, sizeof observation.value);
    deliver(bus, bus->observations, &observation);
}

/* The sense of the task space alone: a robot may have both. */
static bool subscribe_to_sense(struct daemon_bus *bus, enum space_kind space)
{
    if (space == SPACE_CARTESIAN)
        return lcm_subscribe(bus->lcm, "END_EFFECTOR", on_effector, bus) != NULL;
    return lcm_subscribe(bus->lcm, "MARKER", on_marker, bus) != NULL;
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct daemon_bus *bus = user;
    reach_request_t request;

    (void)channel;
    if (!DECODE(reach_request_t, message, &request)) {
        refuse(bus);
        return;
    }
    if (request.kind == REACH_REQUEST_T_EMERGENCY)
        daemon_bus_raise_emergency(bus);
    deliver(bus, bus->requests, &request);
}

static bool create_mailboxes(struct daemon_bus *bus, struct arena *arena)
{
    bus->states = mailbox_create(arena, sizeof(struct received_state), STATES);
    bus->observations = mailbox_create(arena, sizeof(struct observation), OBSERVATIONS);
    bus->requests = mailbox_create(arena, sizeof(reach_request_t), REQUESTS);
    bus->outgoing = mailbox_create(arena, sizeof(struct outgoing), OUTGOING);
    bus->reports = mailbox_create(arena, sizeof(reach_status_t), REPORTS);
    return bus->states && bus->observations && bus->requests && bus->outgoing && bus->reports;
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
    if (sem_init(&bus->arrived, 0, 0) || sem_init(&bus->to_send, 0, 0) ||
        !lcm_subscribe(lcm, "ROBOT_STATE", on_state, bus) || !subscribe_to_sense(bus, space) ||
        !lcm_subscribe(lcm, "REACH_REQUEST", on_request, bus)) {
        snprintf(error, error_size, "cannot subscribe to the bus");
        return NULL;
    }
    return bus;
}

static void *receive(void *user)
{
    struct daemon_bus *bus = user;

    pthread_setname_np(pthread_self(), "reachd-receive");
    while (!atomic_load_explicit(&bus->ending, memory_order_relaxed))
        if (lcm_handle_timeout(bus->lcm, poll_ms) < 0)
            log_error("the bus failed to receive");
    return NULL;
}

static void publish(lcm_t *lcm, const struct outgoing *out)
{
    switch (out->kind) {
    case OUTGOING_COMMAND:
        reach_robot_command_t_publish(lcm, "ROBOT_COMMAND", &out->command);
        break;
    case OUTGOING_SAMPLE:
        reach_sample_t_publish(lcm, "REACH_SAMPLE", &out->sample);
        break;
    case OUTGOING_STATUS:
        reach_status_t_publish(lcm, "REACH_STATUS", &out->status);
        break;
    case OUTGOING_TRACE:
        reach_trace_t_publish(lcm, "REACH_TRACE", &out->trace);
        break;
    }
}

static void *send(void *user)
{
    struct daemon_bus *bus = user;

    pthread_setname_np(pthread_self(), "reachd-send");
    for (;;) {
        while (sem_wait(&bus->to_send) && errno == EINTR)
            ;
        if (mailbox_take(bus->outgoing, &bus->sending))
            publish(bus->lcm, &bus->sending);
        else if (atomic_load_explicit(&bus->ending, memory_order_acquire))
            return NULL;
    }
}

int daemon_bus_start(struct daemon_bus *bus, bool real_time, char *error, size_t error_size)
{
    int priority = real_time ? REALTIME_PRIORITY_BUS : 0;

    if (realtime_thread(&bus->receiver, priority, receive, bus, error, error_size))
        return -1;
    return realtime_thread(&bus->sender, priority, send, bus, error, error_size);
}

void daemon_bus_stop(struct daemon_bus *bus)
{
    atomic_store_explicit(&bus->ending, true, memory_order_release);
    sem_post(&bus->to_send);
    pthread_join(bus->sender, NULL);
    pthread_join(bus->receiver, NULL);
}

struct mailbox *daemon_bus_states(struct daemon_bus *bus)
{
    return bus->states;
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

bool daemon_bus_wait(struct daemon_bus *bus, int milliseconds)
{
    struct timespec end;
    int64_t end_us;

    clock_gettime(CLOCK_REALTIME, &end);
    end_us = (int64_t)end.tv_sec * 1000000 + end.tv_nsec / 1000 + (int64_t)milliseconds * 1000;
    end = (struct timespec){.tv_sec = end_us / 1000000, .tv_nsec = end_us % 1000000 * 1000};
    while (sem_timedwait(&bus->arrived, &end))
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

void daemon_bus_publish_command(struct daemon_bus *bus, const reach_robot_command_t *command)
{
    reach_robot_command_t_publish(bus->lcm, "ROBOT_COMMAND", command);
}

void daemon_bus_raise_emergency(struct daemon_bus *bus)
{
    atomic_store_explicit(&bus->emergency, true, memory_order_release);
}

bool daemon_bus_take_emergency(struct daemon_bus *bus)
{
    return atomic_exchange_explicit(&bus->emergency, false, memory_order_acq_rel);
}

int64_t daemon_bus_refused(const struct daemon_bus *bus)
{
    return atomic_load_explicit(&bus->malformed, memory_order_relaxed) +
           (int64_t)(mailbox_refused(bus->states) + mailbox_refused(bus->observations) +
                     mailbox_refused(bus->requests) + mailbox_refused(bus->outgoing));
}
