/* The manager's side of the protocol is played here: a datagram socket in a folder of our own. */
#include "common/program/notify.h"

#include "tests/unit/suite.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

static char folder[] = "/tmp/reach-notify-XXXXXX";
static char received[2048];
static int manager;

static void listen_at(const char *path, socklen_t length)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    struct timeval patience = {.tv_sec = 5};

    memcpy(address.sun_path, path, length);
    manager = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ck_assert_int_eq(bind(manager, (struct sockaddr *)&address,
                          (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length)),
                     0);
    setsockopt(manager, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

static void listen_in_folder(void)
{
    static char path[64];

    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/socket", folder);
    listen_at(path, (socklen_t)strlen(path));
    setenv("NOTIFY_SOCKET", path, 1);
}

static const char *next_message(void)
{
    ssize_t length = recv(manager, received, sizeof received - 1, 0);

    ck_assert_int_ge(length, 0);
    received[length] = '\0';
    return received;
}

static void leave(void)
{
    close(manager);
    unlink(getenv("NOTIFY_SOCKET"));
    rmdir(folder);
}

START_TEST(test_nobody_listens)
{
    unsetenv("NOTIFY_SOCKET");
    ck_assert_int_eq(notify_send("READY=1"), 0);
    setenv("NOTIFY_SOCKET", "", 1);
    ck_assert_int_eq(notify_send("READY=1"), 0);
}
END_TEST

START_TEST(test_lines_arrive)
{
    listen_in_folder();
    ck_assert_int_eq(notify_send("READY=1\nSTATUS=%s %d", "tick", 7), 1);
    ck_assert_str_eq(next_message(), "READY=1\nSTATUS=tick 7");
    leave();
}
END_TEST

START_TEST(test_name_without_a_file)
{
    char name[64];
    int length = snprintf(name, sizeof name, "@reach-test-%d", (int)getpid());

    setenv("NOTIFY_SOCKET", name, 1);
    name[0] = '\0';
    listen_at(name, (socklen_t)length);
    ck_assert_int_eq(notify_send("STOPPING=1"), 1);
    ck_assert_str_eq(next_message(), "STOPPING=1");
    close(manager);
}
END_TEST

START_TEST(test_what_is_too_long_is_cut)
{
    char text[3000];

    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    listen_in_folder();
    ck_assert_int_eq(notify_send("%s", text), 1);
    ck_assert_uint_eq(strlen(next_message()), 1023);
    leave();
}
END_TEST

START_TEST(test_failures_are_told)
{
    char text[200];

    setenv("NOTIFY_SOCKET", "relative/path", 1);
    ck_assert_int_eq(notify_send("READY=1"), -1);
    ck_assert_int_eq(errno, EAFNOSUPPORT);
    setenv("NOTIFY_SOCKET", "/nowhere/at/all", 1);
    ck_assert_int_eq(notify_send("READY=1"), -1);
    ck_assert_int_eq(errno, ENOENT);
    memset(text, '/', sizeof text);
    text[sizeof text - 1] = '\0';
    setenv("NOTIFY_SOCKET", text, 1);
    ck_assert_int_eq(notify_send("READY=1"), -1);
}
END_TEST

START_TEST(test_watchdog_is_fed_in_time_and_not_more)
{
    struct notify_watchdog watchdog;

    listen_in_folder();
    setenv("WATCHDOG_USEC", "2000000", 1);
    watchdog = notify_watchdog_open();
    ck_assert_int_eq(notify_watchdog_feed(&watchdog, 5000000), 1);
    ck_assert_str_eq(next_message(), "WATCHDOG=1");
    ck_assert_int_eq(notify_watchdog_feed(&watchdog, 5999999), 0);
    ck_assert_int_eq(notify_watchdog_feed(&watchdog, 6000000), 1);
    leave();
}
END_TEST

START_TEST(test_watchdog_of_others)
{
    char process[32];
    struct notify_watchdog watchdog;

    unsetenv("WATCHDOG_USEC");
    watchdog = notify_watchdog_open();
    ck_assert_int_eq(watchdog.interval, 0);
    ck_assert_int_eq(notify_watchdog_feed(&watchdog, 5000000), 0);
    setenv("WATCHDOG_USEC", "2000000", 1);
    setenv("WATCHDOG_PID", "1", 1);
    ck_assert_int_eq(notify_watchdog_open().interval, 0);
    snprintf(process, sizeof process, "%d", (int)getpid());
    setenv("WATCHDOG_PID", process, 1);
    ck_assert_int_eq(notify_watchdog_open().interval, 2000000);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        test_nobody_listens,      test_lines_arrive,
        test_name_without_a_file, test_what_is_too_long_is_cut,
        test_failures_are_told,   test_watchdog_is_fed_in_time_and_not_more,
        test_watchdog_of_others};

    return SUITE_RUN("notify", tests);
}
