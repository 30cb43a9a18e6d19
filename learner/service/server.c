#include "learner/service/server.h"

#include "common/bus/open.h"
#include "common/program/log.h"
#include "common/program/notify.h"
#include "learner/bus/finder_of_bus.h"
#include "learner/service/bus.h"
#include "learner/store/disk_thread.h"

#include <errno.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <time.h>

static const int64_t patience_us = 100000;  /* without anything to do */
static const int64_t tell_period = 1000000; /* us */
static const int64_t repeat_us = 600000000; /* before a trouble is told again */

enum { BATCH = 64 }; /* requests between two looks at what is due */

struct server {
    struct arena *arena;
    struct learner *learner;
    struct model_store *store;
    struct desk *desk;
    struct service_bus *bus;
    struct finder_of_bus finder;
    struct disk_thread disk;
    bool keeps;  /* has a directory */
    bool served; /* the store has a thread: it keeps a model, or looks for a body */
    struct notify_watchdog watchdog;
    int64_t told;
    int64_t told_of[HEALTH_TROUBLES]; /* when; 0 = never */
    struct desk_output output;
};

/* What wakes the serving thread: a request, a sample that is safe, a signal. */
static sem_t work;
static volatile sig_atomic_t end_asked;

static void wake(void *user)
{
    (void)user;
    sem_post(&work);
}

static void on_signal(int signal)
{
    (void)signal;
    end_asked = 1;
    sem_post(&work);
}

static void take_signals(void)
{
    struct sigaction action = {.sa_handler = on_signal};

    sem_init(&work, 0, 0);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static void wait_for_work(void)
{
    const int64_t until = bus_monotonic_us() + patience_us;
    const struct timespec end = {until / 1000000, until % 1000000 * 1000};

    sem_clockwait(&work, CLOCK_MONOTONIC, &end); /* a signal ends it, too */
    while (sem_trywait(&work) == 0)
        ;
}

static void answer_due(struct server *server)
{
    while (desk_due(server->desk, bus_utime(), &server->output.reply))
        service_bus_send(server->bus, DESK_REPLY, &server->output);
}

/* Returns whether the queue may hold more. */
static bool answer_batch(struct server *server)
{
    reach_learner_request_t request;
    int64_t arrived;

    desk_note_losses(server->desk, service_bus_dropped(server->bus),
                     service_bus_malformed(server->bus));
    for (int i = 0; i < BATCH; i++) {
        if (!service_bus_take(server->bus, &request, &arrived))
            return false;
        enum desk_answer answer = desk_take(server->desk, &request, bus_monotonic_us() - arrived,
                                            bus_utime(), &server->output);
        service_bus_send(server->bus, answer, &server->output);
        if (answer == DESK_SILENT)
            disk_thread_wake(&server->disk);
    }
    return true;
}

static void tell_troubles(struct server *server, int64_t now)
{
    const unsigned troubles = desk_troubles(server->desk);
    char text[512];

    for (int trouble = 0; trouble < HEALTH_TROUBLES; trouble++) {
        int64_t *told = &server->told_of[trouble];
        if (!(troubles & 1U << trouble) || (*told != 0 && now - *told < repeat_us))
            continue;
        *told = now;
        desk_tell(server->desk, (enum health_trouble)trouble, text, sizeof text);
        log_warning("%s", text);
    }
}

static void tell_service(struct server *server)
{
    const int64_t now = bus_monotonic_us();
    reach_learner_reply_t reply;

    notify_watchdog_feed(&server->watchdog, now);
    if (now - server->told < tell_period)
        return;
    server->told = now;
    tell_troubles(server, now);
    desk_describe(server->desk, &reply);
    notify_send("STATUS=%lld samples, %d experts, %lld requests, %lld dropped",
                (long long)reply.samples, reply.experts, (long long)reply.requests,
                (long long)reply.dropped);
}

static void serve(struct server *server)
{
    server->watchdog = notify_watchdog_open();
    log_info("ready");
    notify_send("READY=1");
    while (!end_asked) {
        bool more = answer_batch(server);
        answer_due(server);
        tell_service(server);
        if (!more)
            wait_for_work();
    }
    notify_send("STOPPING=1");
}

/* What came before the signal is answered as well, when it is safe. */
static void finish(struct server *server)
{
    service_bus_stop(server->bus);
    while (answer_batch(server))
        ;
    if (server->served) {
        disk_thread_stop(&server->disk);
        model_store_serve(server->store, bus_monotonic_us());
    }
    answer_due(server);
}

static int create(struct server *server, const struct settings *settings, lcm_t *lcm, char *error,
                  size_t error_size)
{
    const struct learner_config *config = &settings->learner.config;
    struct model_store_settings store = settings_store(settings);

    finder_of_bus_init(&server->finder, FINDER_ASKED_BY_LEARNER);
    store.finder = &server->finder.port;
    server->keeps = settings->model_directory[0];
    server->arena = arena_create(learner_memory(config) + model_store_memory() + desk_memory() +
                                 service_bus_memory());
    if (!server->arena) {
        snprintf(error, error_size, "no memory for this capacity");
        return -1;
    }
    server->learner = learner_create(config, server->arena, error, error_size);
    if (!server->learner)
        return -1;
    server->store = model_store_create(&store, server->arena, error, error_size);
    if (!server->store || model_store_open(server->store, server->learner, error, error_size))
        return -1;
    server->served = model_store_is_served(server->store);
    server->desk =
        desk_create(config, server->learner, server->store, server->keeps, server->arena);
    if (!server->desk) {
        snprintf(error, error_size, "out of memory");
        return -1;
    }
    if (settings->learn_frozen)
        desk_learn_frozen(server->desk);
    server->bus = service_bus_create(lcm, wake, NULL, server->arena, error, error_size);
    if (!server->bus)
        return -1;
    server->finder.lcm = lcm;
    server->finder.answers = service_bus_bodies(server->bus);
    return 0;
}

/* The first snapshot is made before the first request is taken, so that samples can be safe. */
static int start(struct server *server, char *error, size_t error_size)
{
    if (server->served) {
        model_store_serve(server->store, bus_monotonic_us());
        server->disk.looked = wake;
        if (disk_thread_start(&server->disk, server->store, error, error_size))
            return -1;
    }
    if (service_bus_start(server->bus, error, error_size) == 0)
        return 0;
    if (server->served)
        disk_thread_stop(&server->disk);
    return -1;
}

int server_run(const struct settings *settings, lcm_t *lcm, char *error, size_t error_size)
{
    static struct server server;
    int result = -1;

    take_signals();
    if (create(&server, settings, lcm, error, error_size) == 0 &&
        start(&server, error, error_size) == 0) {
        serve(&server);
        finish(&server);
        result = 0;
    }
    model_store_close(server.store);
    finder_of_bus_end(&server.finder);
    arena_destroy(server.arena);
    return result;
}
