#include "common/bus/receiver.h"

#include "common/base/thread.h"
#include "common/bus/open.h"
#include "common/program/log.h"

static const int poll_ms = 100; /* how soon the thread sees that it is to end */
static const int64_t say_again_us = 1000000;
static const int64_t held_us = 200000;   /* so long without a turn, it was not running */
static const int64_t backlog_us = 50000; /* what it reads so soon after may have waited */

/* A bus that has failed for good fails at once, and the thread may have a priority over all others:
 * it tries again now and then. */
static void rest_from_failure(int64_t *said)
{
    int64_t now = bus_monotonic_us();

    if (*said == 0 || now - *said >= say_again_us) {
        *said = now;
        log_error("the bus failed to receive");
    }
    sleep_until((now + (int64_t)poll_ms * 1000) * 1000);
}

static void *receive(void *user)
{
    struct bus_receiver *receiver = user;
    int64_t said = 0; /* when the log was last told of a failure, us */

    pthread_setname_np(pthread_self(), receiver->name);
    while (!atomic_load_explicit(&receiver->ending, memory_order_relaxed)) {
        receiver->turned = bus_monotonic_us();
        if (lcm_handle_timeout(receiver->lcm, poll_ms) < 0)
            rest_from_failure(&said);
    }
    return NULL;
}

int64_t bus_receiver_arrived(struct bus_receiver *receiver)
{
    int64_t now = bus_monotonic_us();

    if (now - receiver->turned > held_us) {
        receiver->held_from = receiver->turned + poll_ms * 1000;
        receiver->held_to = now + backlog_us;
    }
    return now < receiver->held_to ? receiver->held_from : now;
}

int bus_receiver_start(struct bus_receiver *receiver, lcm_t *lcm, const char *name, int priority,
                       char *error, size_t error_size)
{
    receiver->lcm = lcm;
    receiver->name = name;
    receiver->turned = bus_monotonic_us();
    receiver->held_from = receiver->held_to = 0;
    atomic_store_explicit(&receiver->ending, false, memory_order_relaxed);
    return thread_start(&receiver->thread, priority, receive, receiver, error, error_size);
}

void bus_receiver_stop(struct bus_receiver *receiver)
{
    atomic_store_explicit(&receiver->ending, true, memory_order_relaxed);
    pthread_join(receiver->thread, NULL);
}
