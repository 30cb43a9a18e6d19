#include "common/program/log.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const char *log_program = "reach";
static enum log_level log_threshold = LOG_LEVEL_INFO;
static int log_journal;
static int log_descriptor = STDERR_FILENO;
static _Atomic long log_lost; /* lines since the last that was told of them */

/* A pipe or a terminal opened once more does not wait, whatever the one who gave it to us wants of
 * his. A file must not be: it would be written from its beginning again. */
static int open_without_waiting(void)
{
    struct stat status;
    int descriptor;

    if (fstat(STDERR_FILENO, &status) || !(S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode)))
        return STDERR_FILENO;
    descriptor = open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    return descriptor < 0 ? STDERR_FILENO : descriptor;
}

void log_open(const char *program, enum log_level least_important)
{
    log_program = program;
    log_threshold = least_important;
    log_journal = getenv("JOURNAL_STREAM") != NULL;
    if (log_descriptor != STDERR_FILENO)
        close(log_descriptor);
    log_descriptor = open_without_waiting();
}

/* What has nobody who reads would end the process (SIGPIPE). */
static ssize_t write_without_signal(const char *line, size_t length)
{
    const struct timespec at_once = {0};
    sigset_t signals, before;
    ssize_t written;

    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &signals, &before);
    written = write(log_descriptor, line, length);
    if (written < 0 && errno == EPIPE)
        sigtimedwait(&signals, NULL, &at_once);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return written;
}

/* One write, so that the lines of several threads do not mix; never waits for who reads. */
static bool put_line(const char *line, size_t length)
{
    struct pollfd room = {.fd = log_descriptor, .events = POLLOUT};
    ssize_t written = send(log_descriptor, line, length, MSG_DONTWAIT | MSG_NOSIGNAL);

    if (written < 0 && errno == ENOTSOCK && poll(&room, 1, 0) == 1)
        written = write_without_signal(line, length);
    return written == (ssize_t)length;
}

static int begin_line(char *line, size_t size, enum log_level level)
{
    return log_journal ? snprintf(line, size, "<%d>", (int)level)
                       : snprintf(line, size, "%s: ", log_program);
}

/* Says how many lines nobody has, as soon as somebody reads again. */
static bool put_lost(void)
{
    long lost = atomic_exchange_explicit(&log_lost, 0, memory_order_relaxed);
    char line[160];
    int length;

    if (lost == 0)
        return true;
    length = begin_line(line, sizeof line, LOG_LEVEL_WARNING);
    length += snprintf(line + length, sizeof line - (size_t)length,
                       "%ld lines of this log are lost: nobody read them in time\n", lost);
    if (put_line(line, (size_t)length))
        return true;
    atomic_fetch_add_explicit(&log_lost, lost, memory_order_relaxed);
    return false;
}

static void log_line(enum log_level level, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));

static void log_line(enum log_level level, const char *format, va_list arguments)
{
    char line[1024];
    int start;
    int length;

    if (level > log_threshold)
        return;
    start = begin_line(line, sizeof line, level);
    length = start + vsnprintf(line + start, sizeof line - (size_t)start - 1, format, arguments);
    if (length > (int)sizeof line - 2)
        length = (int)sizeof line - 2;
    line[length++] = '\n';
    if (!put_lost() || !put_line(line, (size_t)length))
        atomic_fetch_add_explicit(&log_lost, 1, memory_order_relaxed);
}

#define LOG_FUNCTION(name, level)                                                                  \
    void name(const char *format, ...)                                                             \
    {                                                                                              \
        va_list arguments;                                                                         \
        va_start(arguments, format);                                                               \
        log_line(level, format, arguments);                                                        \
        va_end(arguments);                                                                         \
    }

LOG_FUNCTION(log_error, LOG_LEVEL_ERROR)
LOG_FUNCTION(log_warning, LOG_LEVEL_WARNING)
LOG_FUNCTION(log_info, LOG_LEVEL_INFO)
LOG_FUNCTION(log_debug, LOG_LEVEL_DEBUG)
