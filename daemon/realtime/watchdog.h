/* A second pair of eyes on the loop, in a thread of its own whose priority is above the loop's.
 *
 * When the loop stands still for safety.loop_stall, this thread brakes the robot itself: commands
 * that fall to zero with the acceleration of the safety gate, once a period, until the loop moves
 * again; the loop then finds that out and goes to its fault state. It does so before anything else,
 * on a way of its own (brake.h), and leaves the log to another thread. It also receives SIGUSR1,
 * the emergency stop of whoever cannot reach the bus. */
#ifndef REACH_DAEMON_REALTIME_WATCHDOG_H
#define REACH_DAEMON_REALTIME_WATCHDOG_H

#include "common/base/arena.h"
#include "daemon/bus/bus.h"
#include "daemon/config/config.h"

#include <stdbool.h>

struct watchdog;

size_t watchdog_memory(void);

/* Owned by the arena. `url` is the bus that it brakes on, as bus_url gives it; NULL in lockstep,
 * where no time passes while the loop stands still: it does not brake. Returns NULL with one line
 * in `error`. */
struct watchdog *watchdog_create(const struct config *config, struct daemon_bus *bus,
                                 const char *url, struct arena *arena, char *error,
                                 size_t error_size);

/* Blocks SIGUSR1, so that the watchdog's thread alone receives it. Before any thread starts. */
void watchdog_take_signal(void);

/* Starts the thread, in real time with a priority over the loop's. Returns 0, or -1 with one line
 * in `error`. */
int watchdog_start(struct watchdog *watchdog, bool real_time, char *error, size_t error_size);
/* Ends it. The loop must have ended before, or the arm be braked to rest (watchdog_await_rest). */
void watchdog_stop(struct watchdog *watchdog);

/* For the main thread: waits until the loop, which stands still, is no danger: the arm has been
 * braked to rest. Returns false when it is not after so many seconds. */
bool watchdog_await_rest(const struct watchdog *watchdog, double seconds);

/* For the main thread, now and then: what has happened goes to the log. The watchdog itself never
 * writes while the arm may move. */
void watchdog_say(struct watchdog *watchdog);

/* For the loop thread, wait-free: "I am alive", and the command that has just been sent, or NULL.
 */
void watchdog_feed(struct watchdog *watchdog, const reach_robot_command_t *command);

/* For the loop thread: how many braking commands went out since it was last asked. */
int watchdog_take_braked(struct watchdog *watchdog);

#endif
