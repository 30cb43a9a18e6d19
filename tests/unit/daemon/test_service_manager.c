/* What the service manager hears of the daemon; the manager is a socket of ours. */
#include "daemon/housekeeping/service_manager.h"

#include "tests/unit/suite.h"

#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static int manager;
static char received[2048];

static void play_manager(void)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    char name[64];
    int length = snprintf(name, sizeof name, "@reach-service-test-%d", (int)getpid());

    setenv("NOTIFY_SOCKET", name, 1);
    setenv("WATCHDOG_USEC", "200000", 1);
    unsetenv("WATCHDOG_PID");
    memcpy(address.sun_path + 1, name + 1, (size_t)length - 1);
    manager = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ck_assert_int_eq(bind(manager, (struct sockaddr *)&address,
                          (socklen_t)(offsetof(struct sockaddr_un, sun_path) + (size_t)length)),
                     0);
}

/* The next message, "" when there is none: what was sent is there at once. */
static const char *heard(void)
{
    ssize_t length = recv(manager, received, sizeof received - 1, MSG_DONTWAIT);

    received[length < 0 ? 0 : length] = '\0';
    return received;
}

START_TEST(test_ready_and_end)
{
    struct service_manager service;

    play_manager();
    service_manager_begin(&service);
    ck_assert_str_eq(heard(), "READY=1\nSTATUS=waiting for the robot");
    service_manager_end();
    ck_assert_str_eq(heard(), "STOPPING=1\nSTATUS=stopping the arm");
}
END_TEST

START_TEST(test_fed_only_while_the_loop_advances)
{
    struct service_manager service;
    int64_t now = 1000000;

    play_manager();
    service_manager_begin(&service);
    heard();
    for (int64_t ticks = 1; ticks <= 20; ticks++, now += 20000)
        service_manager_tell(&service, now, ticks, false, NULL);
    for (int i = 0; i < 4; i++) /* 400 ms, every 100 ms of 200 */
        ck_assert_str_eq(heard(), "WATCHDOG=1");
    ck_assert_str_eq(heard(), "");
    for (int i = 0; i < 100; i++, now += 20000) {
        service_manager_tell(&service, now, 20, false, NULL);
        ck_assert_str_eq(heard(), "");
    }
    service_manager_tell(&service, now, 21, false, NULL);
    ck_assert_str_eq(heard(), "WATCHDOG=1");
}
END_TEST

START_TEST(test_fed_while_the_simulator_holds_the_clock)
{
    struct service_manager service;

    play_manager();
    service_manager_begin(&service);
    heard();
    service_manager_tell(&service, 1000000, 0, true, NULL);
    ck_assert_str_eq(heard(), "WATCHDOG=1");
}
END_TEST

START_TEST(test_line_for_people_once_a_second)
{
    struct service_manager service;
    reach_status_t status = {.state = REACH_STATUS_T_ACTIVE,
                             .behaviour = REACH_STATUS_T_BABBLE,
                             .phase = REACH_STATUS_T_FIXATE,
                             .progress = 12,
                             .progress_total = 60,
                             .samples = 123,
                             .model_samples = 223,
                             .samples_stored = 220,
                             .storing = 1,
                             .experts = 5,
                             .bad_inputs = 7,
                             .dropped_samples = 1,
                             .compute_max_us = 830.4,
                             .overruns = 2};

    play_manager();
    unsetenv("WATCHDOG_USEC");
    service_manager_begin(&service);
    heard();
    service_manager_tell(&service, 2000000, 1, false, &status);
    ck_assert_str_eq(heard(), "STATUS=active, babble (fixate) 12 of 60; 123 samples, 3 to be "
                              "stored, 5 experts; worst tick 830 us, 2 overruns; 7 messages "
                              "refused, 1 samples dropped");
    status.storing = 0;
    service_manager_tell(&service, 2999999, 2, false, &status);
    ck_assert_str_eq(heard(), "");
    service_manager_tell(&service, 3000000, 3, false, &status);
    ck_assert_ptr_nonnull(strstr(heard(), "123 samples, not stored, 5 experts"));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {test_ready_and_end, test_fed_only_while_the_loop_advances,
                                  test_fed_while_the_simulator_holds_the_clock,
                                  test_line_for_people_once_a_second};

    return SUITE_RUN("service_manager", tests);
}
