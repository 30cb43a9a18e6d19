/* Sends requests and waits for what becomes of them. */
#ifndef REACHCTL_CLIENT_H
#define REACHCTL_CLIENT_H

#include "learner/body/chain/body.h"
#include "tools/reachctl/command.h"

#include <lcm/lcm.h>
#include <reach_status_t.h>

struct client;

/* `url` NULL is the usual bus.
 *   returns NULL with one line in `error` */
struct client *client_create(const char *url, char *error, size_t error_size);
void client_destroy(struct client *client);

/* The bus that it listens on, for whoever wants to hear more; the client's. */
lcm_t *client_bus(struct client *client);

/* Blocks for at most `timeout` seconds until the daemon's next status, which stays valid until the
 * next call.
 *   returns NULL when none came */
const reach_status_t *client_status(struct client *client, double timeout);

/* Each sends the message under a sequence number of its own and waits until it was looked at.
 *   returns 0 when it was done or accepted, else -1 with one line in `error` */
int client_ask_daemon(struct client *client, reach_request_t *request, double timeout, char *error,
                      size_t error_size);
int client_ask_simulator(struct client *client, reach_sim_request_t *request, double timeout,
                         char *error, size_t error_size);

/* Has the daemon tell of the body that it uses.
 *   returns 0, or -1 with one line in `error` */
int client_ask_body(struct client *client, const reach_request_t *request, double timeout,
                    struct body *body, char *error, size_t error_size);

/* Sends without waiting. Returns 0 or -1. */
int client_tell_simulator(struct client *client, reach_sim_request_t *request);

/* Follows the accepted `request` until its behaviour ends, with a progress line on stderr. Fails
 * when the daemon is silent for `timeout` seconds, leaves the behaviour for a fault, or does not
 * reach a target.
 *   returns 0, or -1 with one line in `error` */
int client_follow(struct client *client, const reach_request_t *request, double timeout,
                  char *error, size_t error_size);

/* Until the daemon has left its fault state.
 *   returns 0, or -1 with one line in `error` when that takes longer than `timeout` seconds */
int client_await_recovery(struct client *client, double timeout, char *error, size_t error_size);

#endif
