/* Log lines on stderr, as journald likes them: "<level> program: text".
 *
 * A line never waits for who reads: when a pipe is full, a terminal stopped or a socket's buffer
 * used up, the line is lost and counted, and the next one that gets through is preceded by how many
 * were. A reader that is gone ends nobody (SIGPIPE). A file may still wait for its disk, so that
 * this is not for the real-time loop, nor for the watchdog before the arm rests. */
#ifndef REACH_COMMON_PROGRAM_LOG_H
#define REACH_COMMON_PROGRAM_LOG_H

#ifdef __cplusplus
extern "C" {
#endif

enum log_level {
    LOG_LEVEL_ERROR = 3,
    LOG_LEVEL_WARNING = 4,
    LOG_LEVEL_INFO = 6,
    LOG_LEVEL_DEBUG = 7
};

/* Names the program in front of every line and sets the least important level that is shown; to be
 * called before other threads start.
 * The string is kept, not copied. Under systemd (JOURNAL_STREAM set) lines start with the
 * sd-daemon(3) priority "<3>" instead of the program's name. */
void log_open(const char *program, enum log_level least_important);

/* One line; a newline is added. Thread-safe: one write a line. */
void log_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void log_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));
void log_info(const char *format, ...) __attribute__((format(printf, 1, 2)));
void log_debug(const char *format, ...) __attribute__((format(printf, 1, 2)));

#ifdef __cplusplus
}
#endif
#endif
