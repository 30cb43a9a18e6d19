/* reachd: options, and the order of start and end. */
#include "common/base/arena.h"
#include "common/base/thread.h"
#include "daemon/arguments.h"
#include "daemon/body_start.h"
#include "daemon/bus/bus.h"
#include "daemon/config/load.h"
#include "daemon/config/text.h"
#include "daemon/control/tick.h"
#include "daemon/housekeeping/housekeeping.h"
#include "daemon/model_of_store.h"
#include "daemon/replay/player.h"
#include "daemon/threads.h"
#include "learner/bus/finder_of_bus.h"

#include "common/bus/open.h"
#include "common/program/log.h"

#include <reach_hello_t.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Everything that lives from start to end. */
struct reachd {
    struct arguments arguments;
    struct config config;
    struct reload reload;
    lcm_t *lcm;
    struct bus_claim *claim;
    struct arena *arena;
    struct finder_of_bus finder;
    struct body body_start;
    struct model_store *store;
    struct tick *tick;
    struct threads threads;
    bool loop_stands; /* for good, and may still wake up: its memory is not given back */
};

static bool is_real_time(const struct reachd *reachd)
{
    return !reachd->arguments.lockstep && !reachd->arguments.no_rt &&
           !reachd->arguments.replay_clock;
}

/* LCM starts a thread here, which inherits the priority: messages must not wait in it. */
static int open_bus(struct reachd *reachd, char *error, size_t error_size)
{
    bool real_time = is_real_time(reachd);

    thread_limit_memory();
    if (real_time && thread_enter(THREAD_PRIORITY_BUS, error, error_size))
        return -1;
    reachd->lcm = bus_open(reachd->arguments.url, error, error_size);
    if (!reachd->lcm)
        return -1;
    return real_time ? thread_enter(0, error, error_size) : 0;
}

/* Another daemon on this bus would steer the same robot. */
static int claim_bus(struct reachd *reachd, char *error, size_t error_size)
{
    if (open_bus(reachd, error, error_size))
        return -1;
    return bus_claim_alone(reachd->lcm, REACH_HELLO_T_DAEMON, "reachd", &reachd->claim, error,
                           error_size);
}

/* The control step, and who keeps its model, from which it goes on. */
static int build_tick(struct reachd *reachd, char *error, size_t error_size)
{
    struct tick_settings tick = {.config = &reachd->config};
    struct model_store_settings settings;
    const struct body *start;

    finder_of_bus_init(&reachd->finder, FINDER_ASKED_BY_DAEMON);
    if (body_start_read(&reachd->config, &reachd->body_start, &start, error, error_size))
        return -1;
    settings = model_of_store_settings(&reachd->config, &reachd->finder.port, start);
    reachd->store = model_store_create(&settings, reachd->arena, error, error_size);
    if (!reachd->store)
        return -1;
    tick.model = model_of_store(reachd->store);
    reachd->tick = tick_create(&tick, reachd->arena, error, error_size);
    if (!reachd->tick)
        return -1;
    return model_store_open(reachd->store, tick_learner(reachd->tick), error, error_size);
}

static int build_threads(struct reachd *reachd, char *error, size_t error_size)
{
    const struct config *config = &reachd->config;
    struct threads *threads = &reachd->threads;
    bool lockstep = reachd->arguments.lockstep;
    char url[BUS_URL_MOST];

    bus_url(reachd->arguments.url, url, sizeof url);
    threads->store = reachd->store;
    threads->real_time = is_real_time(reachd);
    threads->bus =
        daemon_bus_create(reachd->lcm, config->space.kind, reachd->arena, error, error_size);
    if (!threads->bus)
        return -1;
    reachd->finder.lcm = reachd->lcm;
    reachd->finder.answers = daemon_bus_bodies(threads->bus);
    threads->watchdog = watchdog_create(config, threads->bus, lockstep ? NULL : url, reachd->arena,
                                        error, error_size);
    if (!threads->watchdog)
        return -1;
    threads->loop = loop_create(config, reachd->tick, threads->bus, threads->watchdog, lockstep,
                                threads->real_time, reachd->arena);
    if (threads->loop)
        return 0;
    snprintf(error, error_size, "out of memory");
    return -1;
}

/* All memory of the loop, in one piece. */
static int build(struct reachd *reachd, char *error, size_t error_size)
{
    bool lockstep = reachd->arguments.lockstep;
    bool real_time = is_real_time(reachd);

    reachd->arena = arena_create(tick_memory(&reachd->config) + model_store_memory() +
                                 daemon_bus_memory() + watchdog_memory() + loop_memory());
    if (!reachd->arena) {
        snprintf(error, error_size, "out of memory");
        return -1;
    }
    if (build_tick(reachd, error, error_size))
        return -1;
    if (build_threads(reachd, error, error_size))
        return -1;
    log_info("%.1f MB for the loop, %s", (double)arena_used(reachd->arena) / 1e6,
             lockstep    ? "lockstep"
             : real_time ? "real time"
                         : "real time without priority");
    return 0;
}

static void tear_down(struct reachd *reachd)
{
    model_store_close(reachd->store);
    if (reachd->loop_stands)
        _exit(1);
    finder_of_bus_end(&reachd->finder);
    if (reachd->lcm)
        lcm_destroy(reachd->lcm);
    bus_claim_free(reachd->claim);
    arena_destroy(reachd->arena);
}

static struct reload reload_of(const struct reachd *reachd)
{
    return (struct reload){.paths = reachd->arguments.configuration.paths,
                           .n_paths = reachd->arguments.configuration.n_paths,
                           .overrides = reachd->arguments.configuration.overrides,
                           .n_overrides = reachd->arguments.configuration.n_overrides,
                           .accepted = &reachd->config};
}

static int check_model(const struct config *config, char *error, size_t error_size)
{
    const struct model_store_settings settings = model_of_store_settings(config, NULL, NULL);

    if (model_store_check(&settings, error, error_size))
        return -1;
    puts(error);
    return 0;
}

static int run_daemon(struct reachd *reachd, char *error, size_t error_size)
{
    struct housekeeping housekeeping = {0};

    reachd->reload = reload_of(reachd);
    housekeeping_take_signals();
    watchdog_take_signal();
    if (claim_bus(reachd, error, error_size) || build(reachd, error, error_size) ||
        threads_start(&reachd->threads, error, error_size))
        return -1;
    log_info("ready");
    housekeeping.loop = reachd->threads.loop;
    housekeeping.bus = reachd->threads.bus;
    housekeeping.watchdog = reachd->threads.watchdog;
    housekeeping.reload = &reachd->reload;
    housekeeping_run(&housekeeping);
    reachd->loop_stands = !threads_stop(&reachd->threads);
    log_info("ended after %lld ticks", (long long)loop_ticks(reachd->threads.loop));
    if (reachd->loop_stands)
        snprintf(error, error_size, "the loop stood still at the end");
    return reachd->loop_stands ? -1 : 0;
}

/* Decisions that were made once, made again. */
static int replay(struct reachd *reachd, char *error, size_t error_size)
{
    const struct arguments *arguments = &reachd->arguments;
    const struct replay_settings settings = {
        .config = arguments->configuration.n_paths > 0 ? &reachd->config : NULL,
        .models = arguments->models,
        .n_models = arguments->n_models,
        .verify = arguments->verify,
    };

    if (arguments->n_replay > 0)
        return player_play_log(arguments->replay, arguments->n_replay, &settings, error,
                               error_size);
    housekeeping_take_signals();
    if (claim_bus(reachd, error, error_size))
        return -1;
    return player_play_bus(reachd->lcm, &settings, error, error_size);
}

static int load_config(struct reachd *reachd, char *error, size_t error_size)
{
    const struct arguments *arguments = &reachd->arguments;

    if (arguments->configuration.n_paths == 0)
        return 0; /* a replay has the recorded one */
    return config_load(&reachd->config, arguments->configuration.paths,
                       arguments->configuration.n_paths, arguments->configuration.overrides,
                       arguments->configuration.n_overrides, error, error_size);
}

static int replay_or_run(struct reachd *reachd, char *error, size_t error_size)
{
    if (reachd->arguments.n_replay > 0 || reachd->arguments.replay_clock)
        return replay(reachd, error, error_size);
    if (reachd->arguments.check_config) {
        config_print(&reachd->config, stdout);
        return 0;
    }
    if (model_of_store_check(&reachd->config, error, error_size))
        return -1;
    return reachd->arguments.check_model ? check_model(&reachd->config, error, error_size)
                                         : run_daemon(reachd, error, error_size);
}

int main(int argc, char **argv)
{
    static struct reachd reachd;
    char error[512] = "";
    int status = arguments_parse(&reachd.arguments, argc, argv);

    if (status >= 0)
        return status;
    log_open("reachd", reachd.arguments.verbose ? LOG_LEVEL_DEBUG : LOG_LEVEL_INFO);
    status =
        load_config(&reachd, error, sizeof error) || replay_or_run(&reachd, error, sizeof error);
    if (status)
        log_error("%s", error);
    tear_down(&reachd);
    return status ? 1 : 0;
}
