/* A log whose reader does not read, or is gone, holds nobody up and ends nobody. */
#include "common/program/log.h"
#include "tests/unit/suite.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

static int reader; /* the other end of stderr */

/* A new stderr whose other end nobody reads yet. */
static void begin(int ends[2])
{
    fflush(stderr);
    ck_assert_int_eq(dup2(ends[1], STDERR_FILENO), STDERR_FILENO);
    close(ends[1]);
    reader = ends[0];
    log_open("test", LOG_LEVEL_INFO);
}

static void begin_pipe(void)
{
    int ends[2];

    ck_assert_int_eq(pipe(ends), 0);
    begin(ends);
}

/* All that can be read now, as text. */
static const char *drain(void)
{
    static char text[1 << 21];
    size_t length = 0;
    ssize_t n;

    fcntl(reader, F_SETFL, O_NONBLOCK);
    while ((n = read(reader, text + length, sizeof text - 1 - length)) > 0)
        length += (size_t)n;
    text[length] = '\0';
    return text;
}

/* Many more lines than fit. Returns how many are there, and that those are whole. */
static long say_too_much(long lines)
{
    long got = 0;
    const char *text;

    for (long i = 0; i < lines; i++)
        log_info("line %ld of many that nobody reads, one like the other", i);
    for (text = drain(); *text; text = strchr(text, '\n') + 1, got++)
        ck_assert_ptr_eq(strstr(text, "test: line "), text);
    ck_assert_int_gt(got, 0);
    ck_assert_int_lt(got, lines);
    return got;
}

static void it_counts_what_is_lost(void)
{
    const long lines = 20000;
    long got = say_too_much(lines), lost;
    char said[200];

    log_info("somebody reads again");
    snprintf(said, sizeof said, "%s", drain());
    ck_assert_int_eq(sscanf(said, "test: %ld lines of this log are lost", &lost), 1);
    ck_assert_int_eq(got + lost, lines);
    ck_assert_ptr_nonnull(strstr(said, "\ntest: somebody reads again\n"));
    log_info("once more");
    ck_assert_str_eq(drain(), "test: once more\n");
}

START_TEST(a_full_pipe_holds_nobody_up)
{
    begin_pipe();
    it_counts_what_is_lost();
}
END_TEST

/* As journald gives it. */
START_TEST(a_full_socket_holds_nobody_up)
{
    int ends[2];

    ck_assert_int_eq(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    begin(ends);
    log_info("first");
    ck_assert_str_eq(drain(), "test: first\n");
    it_counts_what_is_lost();
}
END_TEST

START_TEST(who_has_given_us_the_pipe_keeps_his_own_way_to_wait)
{
    begin_pipe();
    ck_assert_int_eq(fcntl(STDERR_FILENO, F_GETFL) & O_NONBLOCK, 0);
}
END_TEST

START_TEST(a_closed_pipe_ends_nobody)
{
    begin_pipe();
    close(reader);
    log_error("nobody has this");
    log_error("nor this");
}
END_TEST

START_TEST(a_file_is_written_on)
{
    char path[] = "/tmp/test_log_XXXXXX", text[200] = "";
    int ends[2] = {open("/dev/null", O_RDONLY), mkstemp(path)};

    ck_assert_int_eq(dprintf(ends[1], "before\n"), 7);
    begin(ends);
    log_info("after");
    reader = open(path, O_RDONLY);
    ck_assert_int_gt(read(reader, text, sizeof text - 1), 0);
    unlink(path);
    ck_assert_str_eq(text, "before\ntest: after\n");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_full_pipe_holds_nobody_up,
        a_full_socket_holds_nobody_up,
        who_has_given_us_the_pipe_keeps_his_own_way_to_wait,
        a_closed_pipe_ends_nobody,
        a_file_is_written_on,
    };

    /* What waits for a reader who does not read must be noticed, and soon. */
    return suite_run("log", tests, sizeof tests / sizeof tests[0], 10);
}
