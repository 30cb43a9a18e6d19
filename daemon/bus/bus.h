/* The daemon's side of the LCM bus: threads that receive and send, so that the loop touches no
 * socket. The loop meets them only in wait-free mailboxes. */
#ifndef REACH_DAEMON_BUS_BUS_H
#define REACH_DAEMON_BUS_BUS_H

#include "common/base/arena.h"
#include "common/base/mailbox.h"
#include "daemon/bus/incoming.h"
#include "daemon/config/config.h"
#include "daemon/control/senses/observation.h"
#include "daemon/control/senses/refusals.h"

#include <lcm/lcm.h>
#include <reach_request_t.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <reach_sample_t.h>
#include <reach_status_t.h>
#include <reach_trace_t.h>
#include <stdbool.h>
#include <stdint.h>

struct daemon_bus;

/* A robot state with the monotonic time at which it came, us, and its number among all that came.
 */
struct received_state {
    reach_robot_state_t state;
    uint32_t checksum;
    int64_t received;
    int64_t number;
};

struct received_request {
    reach_request_t request;
    uint32_t checksum;
};

size_t daemon_bus_memory(void);

/* Subscribes on `lcm`, which stays the caller's, to the sense of this task space among others.
 * Returns NULL with one line in `error`. */
struct daemon_bus *daemon_bus_create(lcm_t *lcm, enum space_kind space, struct arena *arena,
                                     char *error, size_t error_size);

/* Starts the two threads, in real time with a priority over ordinary load. Returns 0, or -1 with
 * one line in `error`. */
int daemon_bus_start(struct daemon_bus *bus, bool real_time, char *error, size_t error_size);

/* Sends what still waits, then ends and joins the threads. */
void daemon_bus_stop(struct daemon_bus *bus);

/* For the loop thread, wait-free: the oldest state that it has not taken, and at last the newest
 * one. Between them some are passed over when more came than there is room for. Returns false when
 * there is none. */
bool daemon_bus_take_state(struct daemon_bus *bus, struct received_state *received);

/* What else has come, for the loop thread, oldest first. */
struct mailbox *daemon_bus_observations(struct daemon_bus *bus); /* struct observation */
struct mailbox *daemon_bus_requests(struct daemon_bus *bus);     /* struct received_request */

/* For the thread that keeps the model: answers of reach-finder's, struct received_body. */
struct mailbox *daemon_bus_bodies(struct daemon_bus *bus);

/* Lockstep: waits until a message has come, at most `milliseconds`. Returns false when none has. */
bool daemon_bus_wait(struct daemon_bus *bus, int milliseconds);

/* Hands outputs to the sending thread; neither waits nor makes a socket call. What the sender
 * cannot keep up with is dropped and counted. */
void daemon_bus_send_command(struct daemon_bus *bus, const reach_robot_command_t *command);
void daemon_bus_send_sample(struct daemon_bus *bus, const reach_sample_t *sample);
void daemon_bus_send_report(struct daemon_bus *bus, const reach_status_t *status,
                            const reach_trace_t *trace);

/* Main thread: says on the bus what the loop works with, or will after this call. Gives up after
 * 0.1 s in which the one before could not be sent; it is to be called again and again. */
void daemon_bus_send_config(struct daemon_bus *bus, const struct config *config);

/* An emergency stop reaches the loop even when the mailbox of requests is full. */
void daemon_bus_raise_emergency(struct daemon_bus *bus);
/* For the loop thread: whether one was raised since it was last asked. */
bool daemon_bus_take_emergency(struct daemon_bus *bus);

/* The statuses that were sent, for the thread that keeps house: reach_status_t, oldest first. Those
 * that it does not take in time are lost. */
struct mailbox *daemon_bus_reports(struct daemon_bus *bus);

/* Messages refused so far: malformed, or more than the mailboxes hold. `count` is overwritten. */
void daemon_bus_refused(const struct daemon_bus *bus,
                        int64_t count[REFUSALS_CHANNELS][REFUSALS_REASONS]);

#endif
