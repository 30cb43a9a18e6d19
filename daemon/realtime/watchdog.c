#include "daemon/realtime/watchdog.h"

#include "common/base/mailbox.h"
#include "common/base/thread.h"
#include "common/bus/open.h"
#include "common/program/log.h"
#include "daemon/realtime/brake.h"
#include "daemon/realtime/confine.h"
#include "daemon/realtime/stall.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define COMMANDS 64
#define WORDS 64

static const int64_t lockstep_patience_us = 5 * 1000000;
static const int64_t say_again_us = 5 * 1000000; /* while the loop stands still */

/* What the log is to be told, by another thread: a log may be slow. */
enum word { WORD_STANDS, WORD_MOVES, WORD_SIGNAL };

struct told {
    enum word word;
    double seconds; /* of standing still */
};

struct watchdog {
    const struct config *config;
    struct daemon_bus *bus;
    bool brakes;
    struct mailbox *commands; /* from the loop: what it sent */
    struct mailbox *words;    /* to the main thread: struct told */
    _Atomic int64_t beats;
    _Atomic int braked;
    _Atomic bool rests; /* the loop stands still, and the arm has been braked to rest */
    _Atomic bool ending;
    /* The watchdog's thread alone: */
    struct stall stall;
    bool stalled;
    struct brake brake;
    int64_t said; /* when the log was last told, us */
    pthread_t thread;
};

size_t watchdog_memory(void)
{
    return arena_footprint(sizeof(struct watchdog)) +
           mailbox_memory(sizeof(reach_robot_command_t), COMMANDS) +
           mailbox_memory(sizeof(struct told), WORDS);
}

struct watchdog *watchdog_create(const struct config *config, struct daemon_bus *bus,
                                 const char *url, struct arena *arena, char *error,
                                 size_t error_size)
{
    struct watchdog *watchdog = arena_alloc(arena, sizeof *watchdog);

    if (watchdog) {
        watchdog->commands = mailbox_create(arena, sizeof(reach_robot_command_t), COMMANDS);
        watchdog->words = mailbox_create(arena, sizeof(struct told), WORDS);
    }
    if (!watchdog || !watchdog->commands || !watchdog->words) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    watchdog->config = config;
    watchdog->bus = bus;
    watchdog->brakes = url != NULL;
    if (url && brake_open(&watchdog->brake, config, url, error, error_size))
        return NULL;
    return watchdog;
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

    if (call < 0 || (watchdog->brakes && !brake_at_rest(&watchdog->brake)))
        return;
    log_error(
        "the loop made system call %d, which it must not (daemon/realtime/confine.c); the arm is "
        "stopped, reachd ends",
        call);
    abort();
}

static void tell(struct watchdog *watchdog, enum word word, double seconds)
{
    mailbox_put(watchdog->words, &(struct told){word, seconds});
}

static void tell_stalled(struct watchdog *watchdog, int64_t now)
{
    if (now - watchdog->said < say_again_us)
        return;
    watchdog->said = now;
    tell(watchdog, WORD_STANDS, (double)(now - watchdog->stall.moved) * 1e-6);
}

/* Before anything else is done about it. */
static void brake(struct watchdog *watchdog)
{
    if (brake_step(&watchdog->brake))
        atomic_fetch_add_explicit(&watchdog->braked, 1, memory_order_acq_rel);
}

static void look_at_loop(struct watchdog *watchdog)
{
    int64_t now = bus_monotonic_us();
    int64_t patience = watchdog->brakes ? (int64_t)(watchdog->config->safety_loop_stall * 1e6)
                                        : lockstep_patience_us;
    int64_t beats = atomic_load_explicit(&watchdog->beats, memory_order_acquire);
    bool stalled = stall_seen(&watchdog->stall, beats, patience, now) || confine_violation() >= 0;
    reach_robot_command_t command;

    /* While the loop stands still, the newest is what braking has come to. */
    while (mailbox_take(watchdog->commands, &command))
        brake_follow(&watchdog->brake, &command);
    if (stalled && watchdog->brakes)
        brake(watchdog);
    atomic_store_explicit(&watchdog->rests, stalled && brake_at_rest(&watchdog->brake),
                          memory_order_release);
    if (!stalled && watchdog->stalled)
        tell(watchdog, WORD_MOVES, 0);
    watchdog->stalled = stalled;
    if (stalled && confine_violation() < 0)
        tell_stalled(watchdog, now);
    if (stalled)
        end_when_forbidden(watchdog);
}

void watchdog_say(struct watchdog *watchdog)
{
    struct told told;

    while (mailbox_take(watchdog->words, &told)) {
        if (told.word == WORD_STANDS)
            log_error("the loop stands still for %.2f s%s", told.seconds,
                      watchdog->brakes ? ": the watchdog stops the arm" : "");
        else
            log_warning(told.word == WORD_MOVES ? "the loop moves again"
                                                : "SIGUSR1: emergency stop");
    }
}

bool watchdog_await_rest(const struct watchdog *watchdog, double seconds)
{
    int64_t end = bus_monotonic_us() + (int64_t)(seconds * 1e6);

    while (!atomic_load_explicit(&watchdog->rests, memory_order_acquire)) {
        if (bus_monotonic_us() > end)
            return false;
        sleep_until((bus_monotonic_us() + 1000) * 1000);
    }
    return true;
}

static void *watch(void *user)
{
    struct watchdog *watchdog = user;
    const int64_t ns = (int64_t)(watchdog->config->period * 1e9);
    const struct timespec period = {ns / 1000000000, ns % 1000000000};
    sigset_t signals = emergency_signal();

    pthread_setname_np(pthread_self(), "reachd-watch");
    while (!atomic_load_explicit(&watchdog->ending, memory_order_relaxed)) {
        if (sigtimedwait(&signals, NULL, &period) == SIGUSR1) {
            daemon_bus_raise_emergency(watchdog->bus);
            tell(watchdog, WORD_SIGNAL, 0);
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
    watchdog_say(watchdog);
    if (watchdog->brakes)
        brake_close(&watchdog->brake);
}
