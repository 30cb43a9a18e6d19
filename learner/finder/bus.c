#include "learner/finder/bus.h"

#include "common/bus/open.h"
#include "common/bus/receiver.h"
#include "common/program/log.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct finder_bus {
    lcm_t *lcm;
    void (*arrived)(void);
    struct bus_receiver receiver;
    _Atomic int64_t refused;

    pthread_mutex_t mutex; /* of all that follows */
    struct question *waiting;
    struct question_name searched; /* what was taken last */
    bool answered;
    reach_body_t answer; /* of that */
};

static void send_short(struct finder_bus *bus, const struct question_name *name, int8_t outcome,
                       const char *why)
{
    reach_body_t message = {.utime = bus_utime(),
                            .seq = name->seq,
                            .request_utime = name->utime,
                            .outcome = outcome,
                            .error = INFINITY,
                            .doubt = INFINITY};

    snprintf((char *)message.why, sizeof message.why, "%s", why);
    reach_body_t_publish(bus->lcm, "REACH_BODY", &message);
}

static bool same(const struct question_name *a, const struct question_name *b)
{
    return a->utime == b->utime && a->seq == b->seq;
}

static void refuse(struct finder_bus *bus, const struct question_name *name, const char *why)
{
    atomic_fetch_add_explicit(&bus->refused, 1, memory_order_relaxed);
    log_warning("a request was refused: %s", why);
    if (name->seq != 0)
        send_short(bus, name, REACH_BODY_T_REFUSED, why);
}

/* The newest waits. One that has been answered is answered again: the answer was lost. */
static void queue(struct finder_bus *bus, struct question *question,
                  const struct question_name *name)
{
    bool arrived = false;

    pthread_mutex_lock(&bus->mutex);
    if (same(name, &bus->searched)) {
        question_free(question);
        if (bus->answered)
            reach_body_t_publish(bus->lcm, "REACH_BODY", &bus->answer);
    } else {
        question_free(bus->waiting);
        bus->waiting = question;
        arrived = true;
    }
    pthread_mutex_unlock(&bus->mutex);
    if (arrived)
        bus->arrived();
}

static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct finder_bus *bus = user;
    struct question_name name;
    char why[160];
    struct question *question =
        question_read(message->data, message->data_size, &name, why, sizeof why);

    (void)channel;
    if (!question) {
        refuse(bus, &name, why);
        return;
    }
    send_short(bus, &name, REACH_BODY_T_SEARCHING, "the request has come");
    queue(bus, question, &name);
}

struct finder_bus *finder_bus_create(lcm_t *lcm, void (*arrived)(void), char *error,
                                     size_t error_size)
{
    struct finder_bus *bus = calloc(1, sizeof *bus);

    if (bus && lcm_subscribe(lcm, "REACH_BODY_REQUEST", on_request, bus)) {
        bus->lcm = lcm;
        bus->arrived = arrived;
        pthread_mutex_init(&bus->mutex, NULL);
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
    question_free(bus->waiting);
    free(bus);
}

struct question *finder_bus_take(struct finder_bus *bus)
{
    struct question *question;

    pthread_mutex_lock(&bus->mutex);
    question = bus->waiting;
    bus->waiting = NULL;
    if (question) {
        bus->searched = (struct question_name){question->request.utime, question->request.seq};
        bus->answered = false;
    }
    pthread_mutex_unlock(&bus->mutex);
    return question;
}

void finder_bus_answer(struct finder_bus *bus, reach_body_t *answer)
{
    pthread_mutex_lock(&bus->mutex);
    answer->utime = bus_utime();
    answer->seq = bus->searched.seq;
    answer->request_utime = bus->searched.utime;
    bus->answer = *answer;
    bus->answered = true;
    reach_body_t_publish(bus->lcm, "REACH_BODY", answer);
    pthread_mutex_unlock(&bus->mutex);
}

int64_t finder_bus_refused(const struct finder_bus *bus)
{
    return atomic_load_explicit(&bus->refused, memory_order_relaxed);
}
