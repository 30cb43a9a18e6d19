#include "learner/finder/bus.h"

#include "common/bus/open.h"
#include "common/bus/receiver.h"
#include "common/program/log.h"
#include "learner/bus/finder_channels.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One who asks, on channels of its own. */
struct asker {
    struct finder_bus *bus;
    const struct finder_channels *channels;

    /* Under the bus's mutex: */
    struct question *waiting;
    struct question_name searched; /* what was taken last */
    bool answered;
    reach_body_t answer; /* of that */
};

struct finder_bus {
    lcm_t *lcm;
    void (*arrived)(void);
    struct bus_receiver receiver;
    _Atomic int64_t refused;
    pthread_mutex_t mutex;
    struct asker asker[FINDER_ASKERS];
    int taken; /* whose question was taken last; the searching thread's, as that and its answer */
};

static void send(const struct asker *asker, const reach_body_t *message)
{
    reach_body_t_publish(asker->bus->lcm, asker->channels->answer, message);
}

static void send_short(const struct asker *asker, const struct question_name *name, int8_t outcome,
                       const char *why)
{
    reach_body_t message = {.utime = bus_utime(),
                            .seq = name->seq,
                            .request_utime = name->utime,
                            .outcome = outcome,
                            .error = INFINITY,
                            .doubt = INFINITY};

    snprintf((char *)message.why, sizeof message.why, "%s", why);
    send(asker, &message);
}

static bool same(const struct question_name *a, const struct question_name *b)
{
    return a->utime == b->utime && a->seq == b->seq;
}

static void refuse(const struct asker *asker, const struct question_name *name, const char *why)
{
    atomic_fetch_add_explicit(&asker->bus->refused, 1, memory_order_relaxed);
    log_warning("a request on %s was refused: %s", asker->channels->request, why);
    if (name->seq != 0)
        send_short(asker, name, REACH_BODY_T_REFUSED, why);
}

/* The newest waits. One that has been answered is answered again: the answer was lost. */
static void queue(struct asker *asker, struct question *question, const struct question_name *name)
{
    struct finder_bus *bus = asker->bus;
    bool arrived = false;

    pthread_mutex_lock(&bus->mutex);
    if (same(name, &asker->searched)) {
        question_free(question);
        if (asker->answered)
            send(asker, &asker->answer);
    } else {
        question_free(asker->waiting);
        asker->waiting = question;
        arrived = true;
    }
    pthread_mutex_unlock(&bus->mutex);
    if (arrived)
        bus->arrived();
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct asker *asker = user;
    struct question_name name;
    char why[160];
    struct question *question =
        question_read(message->data, message->data_size, &name, why, sizeof why);

    (void)channel;
    if (!question) {
        refuse(asker, &name, why);
        return;
    }
    send_short(asker, &name, REACH_BODY_T_SEARCHING, "the request has come");
    queue(asker, question, &name);
}

static bool subscribe(struct finder_bus *bus)
{
    for (int i = 0; i < FINDER_ASKERS; i++) {
        struct asker *asker = &bus->asker[i];
        asker->bus = bus;
        asker->channels = &finder_channels[i];
        if (!lcm_subscribe(bus->lcm, asker->channels->request, on_request, asker))
            return false;
    }
    return true;
}

struct finder_bus *finder_bus_create(lcm_t *lcm, void (*arrived)(void), char *error,
                                     size_t error_size)
{
    struct finder_bus *bus = calloc(1, sizeof *bus);

    if (bus) {
        bus->lcm = lcm;
        bus->arrived = arrived;
        pthread_mutex_init(&bus->mutex, NULL);
        if (subscribe(bus))
            return bus;
    }
    snprintf(error, error_size, "cannot subscribe to the bus");
    free(bus);
    return NULL;
}

int finder_bus_start(struct finder_bus *bus, char *error, size_t error_size)
{
    return bus_receiver_start(&bus->receiver, bus->lcm, "finder-receive", 0, error, error_size);
}

void finder_bus_stop(struct finder_bus *bus)
{
    bus_receiver_stop(&bus->receiver);
    for (int i = 0; i < FINDER_ASKERS; i++)
        question_free(bus->asker[i].waiting);
    free(bus);
}

/* Those who ask take turns. */
struct question *finder_bus_take(struct finder_bus *bus)
{
    struct question *question = NULL;

    pthread_mutex_lock(&bus->mutex);
    for (int i = 1; i <= FINDER_ASKERS && !question; i++) {
        int next = (bus->taken + i) % FINDER_ASKERS;
        struct asker *asker = &bus->asker[next];
        question = asker->waiting;
        if (!question)
            continue;
        asker->waiting = NULL;
        asker->searched = (struct question_name){question->request.utime, question->request.seq};
        asker->answered = false;
        bus->taken = next;
    }
    pthread_mutex_unlock(&bus->mutex);
    return question;
}

void finder_bus_answer(struct finder_bus *bus, reach_body_t *answer)
{
    struct asker *asker = &bus->asker[bus->taken];

    pthread_mutex_lock(&bus->mutex);
    answer->utime = bus_utime();
    answer->seq = asker->searched.seq;
    answer->request_utime = asker->searched.utime;
    asker->answer = *answer;
    asker->answered = true;
    send(asker, answer);
    pthread_mutex_unlock(&bus->mutex);
}

int64_t finder_bus_refused(const struct finder_bus *bus)
{
    return atomic_load_explicit(&bus->refused, memory_order_relaxed);
}
