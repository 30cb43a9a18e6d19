#include "daemon/realtime/watchdog.h"

#include "common/base/mailbox.h"
#include "common/base/thread.h"
#include "common/bus/open.h"
#include "common/program/log.h"
#include "daemon/control/limits/safety.h"
#include "daemon/realtime/confine.h"
#include "daemon/realtime/stall.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

#define COMMANDS 64

static const int64_t lockstep_patience_us = 5 * 1000000;
static const int64_t say_again_us = 5 * 1000000; /* while the loop stands still */

struct watchdog {
    const struct config *config;
    struct daemon_bus *bus;
    bool brakes;
    struct mailbox *commands; /* from the loop: what it sent */
    _Atomic int64_t beats;
    _Atomic int braked;
    _Atomic bool ending;
    /* The watchdog's thread alone: */
    struct stall stall;
    bool stalled;
    bool has_command;
    reach_robot_command_t command; /* newest that went out */
    int64_t said;                  /* when the log was last told, us */
    pthread_t thread;
};

size_t watchdog_memory(void)
{
    return arena_footprint(sizeof(struct watchdog)) +
           mailbox_memory(sizeof(reach_robot_command_t), COMMANDS);
}

struct watchdog *watchdog_create(const struct config *config, struct daemon_bus *bus, bool brakes,
                                 struct arena *arena)
{
    struct watchdog *watchdog = arena_alloc(arena, sizeof *watchdog);

    if (!watchdog)
        return NULL;
    watchdog->config = config;
    watchdog->bus = bus;
    watchdog->brakes = brakes;
    watchdog->commands = mailbox_create(arena, sizeof(reach_robot_command_t), COMMANDS);
    return watchdog->commands ? watchdog : NULL;
}

static sigset_t emergency_signal(void)
{
    sigset_t signals;

    sigemptyset(&signals);
    sigaddset(&signals, SIGUSR1);
    return signals;
}

void watchdog_take_signal(void)
{
    sigset_t signals = emergency_signal();

    pthread_sigmask(SIG_BLOCK, &signals, NULL);
}

void watchdog_feed(struct watchdog *watchdog, const reach_robot_command_t *command)
{
    if (command)
        mailbox_put(watchdog->commands, command);
    atomic_fetch_add_explicit(&watchdog->beats, 1, memory_order_release);
}

int watchdog_take_braked(struct watchdog *watchdog)
{
    return atomic_exchange_explicit(&watchdog->braked, 0, memory_order_acq_rel);
}

/* What stopped the loop for good: nothing can mend that, and a core tells the developer more. */
static void end_when_forbidden(const struct watchdog *watchdog)
{
    int call = confine_violation();

    if (call < 0 || (watchdog->brakes && !safety_at_rest(watchdog->command.velocity)))
        return;
    log_error(
        "the loop made system call %d, which it must not (daemon/realtime/confine.c); the arm is "
        "stopped, reachd ends",
        call);
    abort();
}

static void say_stalled(struct watchdog *watchdog, int64_t now)
{
    if (now - watchdog->said < say_again_us)
        return;
    watchdog->said = now;
    log_error("the loop stands still for %.2f s%s", (double)(now - watchdog->stall.moved) * 1e-6,
              watchdog->brakes ? ": the watchdog stops the arm" : "");
}

static void brake(struct watchdog *watchdog)
{
    if (!watchdog->has_command)
        return;
    safety_brake(watchdog->config, watchdog->command.velocity);
    watchdog->command.utime = bus_utime();
    daemon_bus_publish_command(watchdog->bus, &watchdog->command);
    atomic_fetch_add_explicit(&watchdog->braked, 1, memory_order_acq_rel);
}

static void look_at_loop(struct watchdog *watchdog)
{
    int64_t now = bus_monotonic_us();
    int64_t patience = watchdog->brakes ? (int64_t)(watchdog->config->safety_loop_stall * 1e6)
                                        : lockstep_patience_us;
    int64_t beats = atomic_load_explicit(&watchdog->beats, memory_order_acquire);
    bool stalled = stall_seen(&watchdog->stall, beats, patience, now) || confine_violation() >= 0;

    /* While the loop stands still, `command` is what braking has come to. */
    while (mailbox_take(watchdog->commands, &watchdog->command))
        watchdog->has_command = true;
    if (!stalled && watchdog->stalled)
        log_warning("the loop moves again");
    watchdog->stalled = stalled;
    if (!stalled)
        return;
    if (confine_violation() < 0)
        say_stalled(watchdog, now);
    if (watchdog->brakes)
        brake(watchdog);
    end_when_forbidden(watchdog);
}

static void *watch(void *user)
{
    struct watchdog *watchdog = user;
    const struct timespec period = {.tv_nsec = (long)(watchdog->config->period * 1e9)};
    sigset_t signals = emergency_signal();

    pthread_setname_np(pthread_self(), "reachd-watch");
    while (!atomic_load_explicit(&watchdog->ending, memory_order_relaxed)) {
        if (sigtimedwait(&signals, NULL, &period) == SIGUSR1) {
            daemon_bus_raise_emergency(watchdog->bus);
            log_warning("SIGUSR1: emergency stop");
        }
        look_at_loop(watchdog);
    }
    return NULL;
}

int watchdog_start(struct watchdog *watchdog, bool real_time, char *error, size_t error_size)
{
    return thread_start(&watchdog->thread, real_time ? THREAD_PRIORITY_WATCHDOG : 0, watch,
                        watchdog, error, error_size);
}

void watchdog_stop(struct watchdog *watchdog)
{
    atomic_store_explicit(&watchdog->ending, true, memory_order_relaxed);
    pthread_join(watchdog->thread, NULL);
}
