#include "common/program/log.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const char *log_program = "reach";
static enum log_level log_threshold = LOG_LEVEL_INFO;
static int log_journal;

void log_open(const char *program, enum log_level least_important)
{
    log_program = program;
    log_threshold = least_important;
    log_journal = getenv("JOURNAL_STREAM") != NULL;
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
    if (log_journal)
        start = snprintf(line, sizeof line, "<%d>", (int)level);
    else
        start = snprintf(line, sizeof line, "%s: ", log_program);
    length = start + vsnprintf(line + start, sizeof line - (size_t)start - 1, format, arguments);
    if (length > (int)sizeof line - 2)
        length = (int)sizeof line - 2;
    line[length++] = '\n';
    /* One write, so that the lines of several threads do not mix; nobody is left to tell of a
     * failure to write to stderr. */
    if (write(STDERR_FILENO, line, (size_t)length) < 0)
        return;
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
