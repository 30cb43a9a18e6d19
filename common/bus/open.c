#include "common/bus/open.h"
#include "common/program/version.h"

#include <arpa/inet.h>
#include <reach_hello_t.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static const char hello_channel[] = "REACH_HELLO";

static const int claim_ms = 300; /* time for another of our kind to answer */
static const int self_test_ms = 500;
static const int receive_buffer_wanted = 8 << 20; /* bytes */

static int64_t clock_us(clockid_t clock)
{
    struct timespec now;

    clock_gettime(clock, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

int64_t bus_utime(void)
{
    return clock_us(CLOCK_REALTIME);
}

int64_t bus_monotonic_us(void)
{
    return clock_us(CLOCK_MONOTONIC);
}

static void set_flag(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    (void)message;
    (void)channel;
    *(bool *)user = true;
}

/* Handles messages until the flag is up or the time is over. Returns -1 when the bus fails. */
static int handle_until(lcm_t *lcm, const bool *flag, int milliseconds)
{
    int64_t end = bus_monotonic_us() + (int64_t)milliseconds * 1000;

    while (!*flag) {
        int64_t left = end - bus_monotonic_us();
        if (left <= 0)
            return 0;
        if (lcm_handle_timeout(lcm, (int)(left / 1000) + 1) < 0)
            return -1;
    }
    return 0;
}

static bool carries_messages(lcm_t *lcm)
{
    bool received = false;
    char channel[64];
    uint64_t random = 0;
    lcm_subscription_t *subscription;

    if (getrandom(&random, sizeof random, 0) != (ssize_t)sizeof random)
        random = (uint64_t)bus_monotonic_us();
    snprintf(channel, sizeof channel, "REACH_SELF_TEST_%016llx", (unsigned long long)random);
    subscription = lcm_subscribe(lcm, channel, set_flag, &received);
    if (lcm_publish(lcm, channel, "", 0) == 0)
        handle_until(lcm, &received, self_test_ms);
    lcm_unsubscribe(lcm, subscription);
    return received;
}

/* Whether packets to the group of a "udpm://group:port" can leave at all. Asked before LCM, which
 * would print a page of advice of its own. Other addresses are left to LCM. */
static bool has_route(const char *url)
{
    char group[64];
    struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons(7667)};
    bool reachable;
    int descriptor;

    if (sscanf(url, "udpm://%63[0-9.]", group) != 1 ||
        inet_pton(AF_INET, group, &address.sin_addr) != 1)
        return true;
    descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0)
        return true;
    reachable = connect(descriptor, (const struct sockaddr *)&address, sizeof address) == 0;
    close(descriptor);
    return reachable;
}

static lcm_t *no_route(const char *url, char *error, size_t error_size)
{
    snprintf(error, error_size,
             "no message gets through %s: a multicast route is missing: ip link set lo multicast "
             "on; ip route add 224.0.0.0/4 dev lo",
             url);
    return NULL;
}

/* Asked of a socket and not of /proc/sys, which a service may not see. The kernel doubles what it
 * grants, for its own use. */
int bus_receive_buffer_most(void)
{
    int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), size = receive_buffer_wanted;
    socklen_t length = sizeof size;

    if (probe < 0)
        return 0;
    if (setsockopt(probe, SOL_SOCKET, SO_RCVBUF, &size, sizeof size) ||
        getsockopt(probe, SOL_SOCKET, SO_RCVBUF, &size, &length))
        size = 0;
    close(probe);
    return size / 2;
}

void bus_url(const char *url, char *full, size_t size)
{
    const char *environment = getenv("LCM_DEFAULT_URL");
    /* LCM complains aloud about a wish that is not met. */
    int buffer = bus_receive_buffer_most();

    if (!url || !*url)
        url = environment && *environment ? environment : BUS_DEFAULT_URL;
    if (strncmp(url, "udpm:", 5) != 0 || strstr(url, "recv_buf_size") || buffer <= 0)
        snprintf(full, size, "%s", url);
    else
        snprintf(full, size, "%s%crecv_buf_size=%d", url, strchr(url, '?') ? '&' : '?', buffer);
}

lcm_t *bus_open(const char *given, char *error, size_t error_size)
{
    char url[BUS_URL_MOST];
    lcm_t *lcm;

    bus_url(given, url, sizeof url);
    if (!has_route(url))
        return no_route(url, error, error_size);
    lcm = lcm_create(url);
    if (!lcm) {
        snprintf(error, error_size, "LCM cannot open %s: is the address right?", url);
        return NULL;
    }
    if (!carries_messages(lcm)) {
        lcm_destroy(lcm);
        return no_route(url, error, error_size);
    }
    return lcm;
}

struct bus_claim {
    lcm_t *lcm;
    int64_t instance;
    int8_t role;
    bool taken;
};

static void sign(reach_hello_t *hello)
{
    snprintf((char *)hello->revision, sizeof hello->revision, "%s", reach_version);
}

static void on_hello(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct bus_claim *claim = (struct bus_claim *)user;
    reach_hello_t hello;

    (void)channel;
    if (reach_hello_t_decode(message->data, 0, (int)message->data_size, &hello) < 0 ||
        hello.role != claim->role)
        return;
    if (hello.answer) {
        if (hello.instance == claim->instance)
            claim->taken = true;
    } else if (hello.instance != claim->instance) {
        hello.answer = 1;
        sign(&hello);
        reach_hello_t_publish(claim->lcm, hello_channel, &hello);
    }
}

int bus_claim_role(lcm_t *lcm, int8_t role, int wait_ms, struct bus_claim **result)
{
    struct bus_claim *claim = (struct bus_claim *)calloc(1, sizeof *claim);
    reach_hello_t hello = {.utime = bus_utime(), .role = role};

    *result = claim;
    if (!claim || getrandom(&claim->instance, sizeof claim->instance, 0) < 0)
        return -1;
    claim->lcm = lcm;
    claim->role = role;
    hello.instance = claim->instance;
    sign(&hello);
    if (!lcm_subscribe(lcm, hello_channel, on_hello, claim) ||
        reach_hello_t_publish(lcm, hello_channel, &hello) < 0 ||
        handle_until(lcm, &claim->taken, wait_ms) < 0)
        return -1;
    return claim->taken ? 1 : 0;
}

int bus_claim_alone(lcm_t *lcm, int8_t role, const char *program, struct bus_claim **claim,
                    char *error, size_t error_size)
{
    switch (bus_claim_role(lcm, role, claim_ms, claim)) {
    case 0:
        return 0;
    case 1:
        snprintf(error, error_size, "another %s is on this bus; end it first, or use --url",
                 program);
        return -1;
    default:
        snprintf(error, error_size, "the bus failed");
        return -1;
    }
}

void bus_claim_free(struct bus_claim *claim)
{
    free(claim);
}
