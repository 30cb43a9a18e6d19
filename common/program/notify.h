/* Tells the service manager how this program is: the protocol of sd_notify(3), datagrams of lines
 * NAME=value to the socket that $NOTIFY_SOCKET names. Ours and not libsystemd's, since the protocol
 * is one send and promised to stay, and the library would be one more thing to have everywhere.
 *
 * Without $NOTIFY_SOCKET, as in a terminal, nothing is sent. Not for the real-time loop. */
#ifndef REACH_COMMON_PROGRAM_NOTIFY_H
#define REACH_COMMON_PROGRAM_NOTIFY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sends lines such as "READY=1\nSTATUS=in lockstep"; what is longer than 1 kB is cut.
 *   returns 1 when sent, 0 when nobody asked for it, -1 with errno when it failed. */
int notify_send(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Signs of life for the manager's watchdog, at most twice as often as it asks for. */
struct notify_watchdog {
    int64_t interval; /* us, 0 = nobody waits for them */
    int64_t fed;      /* when last, us of CLOCK_MONOTONIC */
};

/* Reads $WATCHDOG_USEC and $WATCHDOG_PID. */
struct notify_watchdog notify_watchdog_open(void);

/* To be called as long as all is well, with the monotonic time. Returns whether it sent one. */
int notify_watchdog_feed(struct notify_watchdog *watchdog, int64_t now);

#ifdef __cplusplus
}
#endif
#endif
