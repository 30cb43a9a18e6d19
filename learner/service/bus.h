/* The service's side of the LCM bus: a thread that receives, so that a request is taken from the
 * socket while another is worked on, and a queue of a fixed size between the two. */
#ifndef REACH_LEARNER_SERVICE_BUS_H
#define REACH_LEARNER_SERVICE_BUS_H

#include "common/base/mailbox.h"
#include "learner/service/desk.h"

#include <lcm/lcm.h>
#include <stdbool.h>
#include <stdint.h>

struct service_bus;

size_t service_bus_memory(void);

/* Subscribes on `lcm`, which stays the caller's. `arrived` is called by the receiving thread for
 * each request that was queued. Returns NULL with one line in `error`. */
struct service_bus *service_bus_create(lcm_t *lcm, void (*arrived)(void *user), void *user,
                                       struct arena *arena, char *error, size_t error_size);

int service_bus_start(struct service_bus *bus, char *error, size_t error_size);

/* Ends and joins the thread; what is queued stays. */
void service_bus_stop(struct service_bus *bus);

/* The oldest request of the queue, and when it arrived (us, bus_monotonic_us()). Returns false when
 * the queue is empty. */
bool service_bus_take(struct service_bus *bus, reach_learner_request_t *request, int64_t *arrived);

/* Answers of reach-finder's, struct received_body, for the thread that serves the store. */
struct mailbox *service_bus_bodies(struct service_bus *bus);

/* Since start: requests that found the queue full, and messages that were none. */
int64_t service_bus_dropped(const struct service_bus *bus);
int64_t service_bus_malformed(const struct service_bus *bus);

/* Sends an answer; DESK_SILENT: nothing. */
void service_bus_send(struct service_bus *bus, enum desk_answer answer,
                      const struct desk_output *output);

#endif
