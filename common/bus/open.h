/* What every program needs of the LCM bus: opening it with a check that it carries messages, and
 * finding out whether another of our kind is already there. */
#ifndef REACH_COMMON_BUS_OPEN_H
#define REACH_COMMON_BUS_OPEN_H

#include <lcm/lcm.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ttl=0: messages stay on this machine. */
#define BUS_DEFAULT_URL "udpm://239.255.76.67:7667?ttl=0"

enum { BUS_URL_MOST = 512 };

/* The whole address: `url`, NULL or "" being $LCM_DEFAULT_URL, else BUS_DEFAULT_URL; with the
 * largest receive buffer that the kernel grants, unless it names one. Pictures pass through every
 * socket of the bus, and a small buffer loses what comes behind them. */
void bus_url(const char *url, char *full, size_t size);

/* The largest receive buffer that the kernel grants a socket here, at most 8 MB; 0 when it cannot
 * be found out. */
int bus_receive_buffer_most(void);

/* Opens the bus and sends itself a message, since LCM itself reports nothing when the multicast
 * route is missing. `url` NULL or "" is $LCM_DEFAULT_URL, else BUS_DEFAULT_URL.
 *   returns the instance, to be freed with lcm_destroy, or NULL with one line in `error` that
 *   says what to do. */
lcm_t *bus_open(const char *url, char *error, size_t error_size);

/* Lets `claim` answer whoever else asks for this role (a constant of hello_t). Must be called
 * from the thread that will handle messages, before it starts. Blocks for `wait_ms`.
 *   returns 0, 1 when another program already has the role, -1 when the bus fails. */
struct bus_claim;
int bus_claim_role(lcm_t *lcm, int8_t role, int wait_ms, struct bus_claim **claim);
/* The same for `program`, of which a bus bears one. Returns 0, or -1 with one line in `error`. */
int bus_claim_alone(lcm_t *lcm, int8_t role, const char *program, struct bus_claim **claim,
                    char *error, size_t error_size);
void bus_claim_free(struct bus_claim *claim);

/* Microseconds since the epoch, CLOCK_REALTIME. */
int64_t bus_utime(void);

/* Microseconds of CLOCK_MONOTONIC, for waiting. */
int64_t bus_monotonic_us(void);

#ifdef __cplusplus
}
#endif
#endif
