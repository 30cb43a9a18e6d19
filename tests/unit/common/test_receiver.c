/* A bus that has failed: the thread that receives says so once a second, and rests between. */
#include "common/base/thread.h"
#include "common/bus/open.h"
#include "common/bus/receiver.h"
#include "common/program/log.h"
#include "tests/unit/suite.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

static _Atomic int calls;

/* In the place of LCM's: fails at once, as it does when its socket is gone. */
int lcm_handle_timeout(lcm_t *lcm, int milliseconds)
{
    (void)lcm, (void)milliseconds;
    atomic_fetch_add(&calls, 1);
    return -1;
}

START_TEST(a_failed_bus_keeps_no_processor_and_no_log_busy)
{
    struct bus_receiver receiver;
    char error[200], log[4096] = "";
    int ends[2], lines = 0;

    ck_assert_int_eq(pipe2(ends, O_NONBLOCK), 0);
    dup2(ends[1], STDERR_FILENO);
    log_open("test", LOG_LEVEL_INFO);
    ck_assert_int_eq(bus_receiver_start(&receiver, NULL, "receiver", 0, error, sizeof error), 0);
    sleep_until((bus_monotonic_us() + 1300000) * 1000);
    bus_receiver_stop(&receiver);
    ck_assert_int_ge(atomic_load(&calls), 3);
    ck_assert_int_le(atomic_load(&calls), 20);
    ck_assert_int_gt(read(ends[0], log, sizeof log - 1), 0);
    for (const char *line = log; (line = strstr(line, "the bus failed to receive")); line++)
        lines++;
    ck_assert_int_ge(lines, 1);
    ck_assert_int_le(lines, 2);
}
END_TEST

START_TEST(what_waited_for_a_process_that_was_stopped_came_before)
{
    const int64_t now = bus_monotonic_us(), second = 1000000;
    struct bus_receiver receiver = {.turned = now - second / 20};

    ck_assert_int_ge(bus_receiver_arrived(&receiver), now);
    receiver.turned = now - second;
    ck_assert_int_lt(bus_receiver_arrived(&receiver), now - second / 2);
    receiver.turned = bus_monotonic_us(); /* its next message waited as long */
    ck_assert_int_lt(bus_receiver_arrived(&receiver), now - second / 2);
    sleep_until((bus_monotonic_us() + second / 10) * 1000);
    ck_assert_int_gt(bus_receiver_arrived(&receiver), now);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_failed_bus_keeps_no_processor_and_no_log_busy,
        what_waited_for_a_process_that_was_stopped_came_before,
    };

    return SUITE_RUN("receiver", tests);
}
