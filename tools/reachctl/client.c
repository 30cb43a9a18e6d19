#include "tools/reachctl/client.h"

#include "common/bus/open.h"
#include "common/bus/status_words.h"
#include "learner/bus/body_message.h"
#include "tools/reachctl/outcome.h"
#include "tools/reachctl/view/show.h"

#include <lcm/lcm.h>
#include <reach_config_t.h>
#include <reach_sim_truth_t.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const int64_t resend_us = 500000;
static const double config_seconds = 1.5;

struct client {
    lcm_t *lcm;
    bool has_status;
    reach_status_t status;
    int64_t simulator_done; /* newest sim_request_t.seq carried out */
    bool has_body;
    reach_body_t body; /* newest that can be used */
    bool has_config;
    reach_config_t config;
};

static void on_status(const lcm_recv_buf_t *message, const char *channel,
                      const reach_status_t *status, void *user)
{
    struct client *client = (struct client *)user;

    (void)message;
    (void)channel;
    client->status = *status;
    client->has_status = true;
}

static void on_truth(const lcm_recv_buf_t *message, const char *channel,
                     const reach_sim_truth_t *truth, void *user)
{
    (void)message;
    (void)channel;
    ((struct client *)user)->simulator_done = truth->request_seq;
}

static void on_body(const lcm_recv_buf_t *message, const char *channel, const reach_body_t *body,
                    void *user)
{
    struct client *client = (struct client *)user;

    (void)message;
    (void)channel;
    client->body = *body;
    client->has_body = true;
}

static void on_config(const lcm_recv_buf_t *message, const char *channel,
                      const reach_config_t *config, void *user)
{
    struct client *client = (struct client *)user;

    (void)message;
    (void)channel;
    client->config = *config;
    client->has_config = true;
}

struct client *client_create(const char *url, char *error, size_t error_size)
{
    lcm_t *lcm = bus_open(url, error, error_size);
    struct client *client;

    if (!lcm)
        return NULL;
    client = calloc(1, sizeof *client);
    if (!client) {
        snprintf(error, error_size, "out of memory");
        lcm_destroy(lcm);
        return NULL;
    }
    client->lcm = lcm;
    reach_status_t_subscribe(lcm, "REACH_STATUS", on_status, client);
    reach_sim_truth_t_subscribe(lcm, "SIM_TRUTH", on_truth, client);
    reach_body_t_subscribe(lcm, "REACH_BODY_IN_USE", on_body, client);
    reach_config_t_subscribe(lcm, "REACH_CONFIG", on_config, client);
    return client;
}

void client_destroy(struct client *client)
{
    if (!client)
        return;
    lcm_destroy(client->lcm);
    free(client);
}

lcm_t *client_bus(struct client *client)
{
    return client->lcm;
}

/* Handles messages for at most this long. Returns false when the time is over. */
static bool handle_before(struct client *client, int64_t deadline)
{
    int64_t left = deadline - bus_monotonic_us();

    return left > 0 && lcm_handle_timeout(client->lcm, (int)(left / 1000) + 1) >= 0;
}

static int64_t deadline_after(double seconds)
{
    return bus_monotonic_us() + (int64_t)(seconds * 1e6);
}

const reach_status_t *client_status(struct client *client, double timeout)
{
    int64_t deadline = deadline_after(timeout);

    client->has_status = false;
    while (!client->has_status)
        if (!handle_before(client, deadline))
            return NULL;
    return &client->status;
}

static int no_daemon(double timeout, char *error, size_t error_size)
{
    snprintf(error, error_size,
             "no answer from reachd in %g s: it does not run, or no robot state reaches it",
             timeout);
    return -1;
}

/* Every call has a number of its own: microseconds of the clock are never the same twice. */
static int64_t fresh_seq(void)
{
    return bus_utime();
}

/* What became of the request; what is done about the model is told however much is asked after it.
 */
static int8_t result_of(const reach_status_t *status, const reach_request_t *request)
{
    if (status->model_request_seq == request->seq)
        return status->model_result;
    return status->request_seq == request->seq ? status->request_result : REACH_STATUS_T_PENDING;
}

static bool answers(const reach_status_t *status, const reach_request_t *request)
{
    return status && result_of(status, request) != REACH_STATUS_T_PENDING;
}

/* Numbers are of the clock: a greater one is somebody's later wish, which ours must not undo. */
static bool is_overtaken(const struct client *client, const reach_request_t *request)
{
    return client->status.request_seq > request->seq;
}

/* Which file a save or load was about: the daemon tells its configuration once a second. */
static void name_model(struct client *client, int32_t number, char *error, size_t error_size)
{
    static const char key[] = "model.directory=";
    int64_t deadline = deadline_after(config_seconds);
    char text[sizeof client->config.text + 1] = "";
    const char *found;
    size_t used = strlen(error);

    while (!client->has_config)
        if (!handle_before(client, deadline))
            return;
    memcpy(text, client->config.text, sizeof client->config.text);
    found = strstr(text, key);
    if (found && (found == text || found[-1] == '\n')) {
        found += sizeof key - 1;
        snprintf(error + used, error_size - used, ": %.*s/model-%d.imle", (int)strcspn(found, "\n"),
                 found, number);
    }
}

/* Sent again now and then, which changes nothing: the daemon may just be starting. */
int client_ask_daemon(struct client *client, reach_request_t *request, double timeout, char *error,
                      size_t error_size)
{
    int64_t now = bus_monotonic_us(), deadline = deadline_after(timeout), due = now;
    const reach_status_t *status = NULL;

    request->utime = bus_utime();
    request->seq = fresh_seq();
    for (; !answers(status, request); now = bus_monotonic_us()) {
        if (now >= deadline)
            return no_daemon(timeout, error, error_size);
        if (now >= due) {
            if (!is_overtaken(client, request))
                reach_request_t_publish(client->lcm, "REACH_REQUEST", request);
            due = now + resend_us;
        }
        status = client_status(client, (double)((due < deadline ? due : deadline) - now) * 1e-6);
    }
    if (result_of(status, request) == REACH_STATUS_T_ACCEPTED)
        return 0;
    snprintf(error, error_size, "reachd: %s", status_result_word(result_of(status, request)));
    if (request->kind == REACH_REQUEST_T_SAVE || request->kind == REACH_REQUEST_T_LOAD)
        name_model(client, request->count, error, error_size);
    return -1;
}

int client_ask_body(struct client *client, const reach_request_t *request, double timeout,
                    struct body *body, char *error, size_t error_size)
{
    reach_request_t asked = *request;
    int64_t deadline = deadline_after(timeout);

    client->has_body = false;
    if (client_ask_daemon(client, &asked, timeout, error, error_size)) {
        if (client->status.request_seq == asked.seq)
            snprintf(error, error_size, "no body is found: %s",
                     status_body_word(client->status.body));
        return -1;
    }
    while (!client->has_body)
        if (!handle_before(client, deadline))
            return no_daemon(timeout, error, error_size);
    if (body_message_take(&client->body, body))
        return 0;
    snprintf(error, error_size, "the body that came on REACH_BODY_IN_USE cannot be used");
    return -1;
}

int client_tell_simulator(struct client *client, reach_sim_request_t *request)
{
    request->utime = bus_utime();
    request->seq = fresh_seq();
    return reach_sim_request_t_publish(client->lcm, "SIM_REQUEST", request);
}

int client_ask_simulator(struct client *client, reach_sim_request_t *request, double timeout,
                         char *error, size_t error_size)
{
    int64_t deadline = deadline_after(timeout);

    client_tell_simulator(client, request);
    while (client->simulator_done != request->seq)
        if (!handle_before(client, deadline)) {
            snprintf(error, error_size,
                     "no answer from simrobot in %g s: it does not run, runs with --no-truth, or "
                     "refused the request (see its log)",
                     timeout);
            return -1;
        }
    return 0;
}

int client_follow(struct client *client, const reach_request_t *request, double timeout,
                  char *error, size_t error_size)
{
    reach_status_t at_work = client->status;
    struct outcome outcome = {0};

    outcome_take(&outcome, &at_work);
    for (;;) {
        const reach_status_t *status = client_status(client, timeout);
        if (!status)
            return no_daemon(timeout, error, error_size);
        if (status->request_seq != request->seq) {
            snprintf(error, error_size, "another request has replaced this one");
            return -1;
        }
        if (status->state == REACH_STATUS_T_FAULT) {
            snprintf(error, error_size, "reachd is in its fault state; reachctl reset-fault");
            return -1;
        }
        if (status->behaviour == REACH_STATUS_T_NONE) {
            show_end(&at_work, status);
            return request->kind == REACH_REQUEST_T_REACH
                       ? outcome_end(&outcome, &at_work, error, error_size)
                       : 0;
        }
        outcome_take(&outcome, status);
        show_progress(status);
        at_work = *status;
    }
}

int client_await_recovery(struct client *client, double timeout, char *error, size_t error_size)
{
    int64_t deadline = deadline_after(timeout);

    while (client->status.state == REACH_STATUS_T_FAULT) {
        if (bus_monotonic_us() >= deadline) {
            snprintf(error, error_size, "reachd is still in its fault state: %s",
                     status_fault_word(client->status.fault));
            return -1;
        }
        if (!client_status(client, timeout))
            return no_daemon(timeout, error, error_size);
    }
    return 0;
}
