#include "common/logs/event_log.h"

#include "common/base/big_endian.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MARK = 4, WINDOW = 1 << 20, COPY = 1 << 16 };

static const unsigned char mark[MARK] = {0xed, 0xa1, 0xda, 0x01};

struct event_log {
    int file;
    int64_t size; /* when it was opened */
    size_t keep;
    int64_t next; /* where the next event is looked for */
    int error;    /* errno of a read that failed */

    /* A piece of the file. */
    unsigned char *window;
    size_t capacity, filled;
    int64_t window_at;
    char channel[EVENT_LOG_CHANNEL];
};

/* Reads until `size` bytes are there or the file ends. Returns how many are. */
static size_t read_at(struct event_log *log, unsigned char *to, size_t size, int64_t at)
{
    size_t filled = 0;

    while (filled < size) {
        ssize_t got = pread(log->file, to + filled, size - filled, (off_t)at + (off_t)filled);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            log->error = errno;
        if (got <= 0)
            break;
        filled += (size_t)got;
    }
    return filled;
}

static bool in_window(const struct event_log *log, int64_t at, size_t size)
{
    return at >= log->window_at && at + (int64_t)size <= log->window_at + (int64_t)log->filled;
}

/* Makes the window hold at least `size` bytes. */
static bool grow(struct event_log *log, size_t size)
{
    size_t capacity = size > WINDOW ? size : WINDOW;
    unsigned char *window;

    if (capacity <= log->capacity)
        return true;
    window = realloc(log->window, capacity);
    if (!window) {
        log->error = ENOMEM;
        return false;
    }
    log->window = window;
    log->capacity = capacity;
    return true;
}

/* `size` bytes of the file from `at` on; NULL when they are not there. */
static const unsigned char *look(struct event_log *log, int64_t at, size_t size)
{
    if (at + (int64_t)size > log->size)
        return NULL;
    if (!in_window(log, at, size)) {
        if (!grow(log, size))
            return NULL;
        log->window_at = at;
        log->filled = read_at(log, log->window, log->capacity, at);
        if (log->filled < size)
            return NULL;
    }
    return log->window + (at - log->window_at);
}

/* Whether an event that ends at `at` is followed by the next one or by the end. A length may point
 * anywhere, so the window stays where it is. What a killed logger has begun may be part of a mark.
 */
static bool ends_at(struct event_log *log, int64_t at)
{
    unsigned char found[MARK];
    int64_t left = log->size - at;
    size_t size = left < MARK ? (size_t)left : MARK;

    if (left < 0)
        return false;
    if (in_window(log, at, size))
        return memcmp(log->window + (at - log->window_at), mark, size) == 0;
    return read_at(log, found, size, at) == size && memcmp(found, mark, size) == 0;
}

static int64_t number_at(const unsigned char *bytes)
{
    return (int64_t)big_endian(bytes, 8);
}

/* Whether an event begins at `at`; it is described in *event, and the next one is looked for behind
 * it. */
static bool is_event(struct event_log *log, int64_t at, struct event *event)
{
    const unsigned char *header = look(log, at, EVENT_LOG_HEADER);
    uint32_t name, size;
    int64_t end;

    if (!header || memcmp(header, mark, MARK) != 0)
        return false;
    name = (uint32_t)big_endian(header + 20, 4);
    size = (uint32_t)big_endian(header + 24, 4);
    if (name == 0 || name >= EVENT_LOG_CHANNEL || size > EVENT_LOG_MESSAGE)
        return false;
    *event = (struct event){.number = number_at(header + MARK),
                            .stamp = number_at(header + MARK + 8),
                            .channel = log->channel,
                            .size = size,
                            .position = at};
    end = at + EVENT_LOG_HEADER + (int64_t)name + (int64_t)size;
    if (!ends_at(log, end))
        return false;
    header = look(log, at, EVENT_LOG_HEADER + name);
    if (!header || memchr(header + EVENT_LOG_HEADER, '\0', name))
        return false;
    memcpy(log->channel, header + EVENT_LOG_HEADER, name);
    log->channel[name] = '\0';
    log->next = end;
    return true;
}

/* Where the next mark is, from `at` on; the file's size when there is none. */
static int64_t next_mark(struct event_log *log, int64_t at)
{
    while (at + MARK <= log->size) {
        int64_t left = log->size - at;
        size_t size = left < WINDOW ? (size_t)left : WINDOW;
        const unsigned char *bytes = look(log, at, size);
        const unsigned char *found = bytes ? memmem(bytes, size, mark, MARK) : NULL;
        if (!bytes)
            break;
        if (found)
            return at + (found - bytes);
        at += (int64_t)size - MARK + 1;
    }
    return log->size;
}

int event_log_next(struct event_log *log, struct event *event, char *error, size_t error_size)
{
    int64_t from = log->next;
    int64_t at = from;

    while (at < log->size && !is_event(log, at, event) && log->error == 0)
        at = next_mark(log, at + 1);
    if (at >= log->size) {
        *event = (struct event){.channel = "", .position = log->size};
        log->next = log->size;
    } else if (log->error == 0 && event->size <= log->keep) {
        size_t before = (size_t)(log->next - at) - event->size;
        const unsigned char *whole = look(log, at, before + event->size);
        event->data = whole ? whole + before : NULL;
    }
    event->skipped = event->position - from;
    if (log->error == 0)
        return at < log->size;
    snprintf(error, error_size, "byte %lld: %s", (long long)at, strerror(log->error));
    return -1;
}

const unsigned char *event_log_bytes(struct event_log *log, const struct event *event, size_t *size)
{
    *size = (size_t)(log->next - event->position);
    return event->size <= log->keep ? look(log, event->position, *size) : NULL;
}

void event_log_rewind(struct event_log *log)
{
    log->next = 0;
    free(log->window);
    log->window = NULL;
    log->capacity = log->filled = 0;
}

static int write_all(int to, const unsigned char *bytes, size_t size)
{
    while (size > 0) {
        ssize_t put = write(to, bytes, size);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            return -1;
        bytes += put;
        size -= (size_t)put;
    }
    return 0;
}

static int copy_all(int from, int to)
{
    unsigned char *block = malloc(COPY);
    ssize_t got = block ? 1 : -1;

    while (block && (got = read(from, block, COPY)) != 0) {
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0 || write_all(to, block, (size_t)got))
            break;
    }
    free(block);
    return got == 0 ? 0 : -1;
}

/* What can be read once, such as a pipe, as an unnamed file in its place. */
static int copy_of(int file)
{
    FILE *unnamed = tmpfile();
    int copy = unnamed ? dup(fileno(unnamed)) : -1;

    if (unnamed)
        fclose(unnamed);
    if (copy >= 0 && copy_all(file, copy)) {
        close(copy);
        copy = -1;
    }
    close(file);
    return copy;
}

/* The file, or -1 with errno; `size` gets what is in it. */
static int open_file(const char *path, int64_t *size)
{
    int file = strcmp(path, "-") == 0 ? dup(STDIN_FILENO) : open(path, O_RDONLY | O_CLOEXEC);
    struct stat about = {0};

    if (file >= 0 && fstat(file, &about) == 0 && !S_ISREG(about.st_mode) &&
        !S_ISDIR(about.st_mode)) {
        file = copy_of(file);
        if (file >= 0 && fstat(file, &about))
            about.st_size = 0;
    }
    if (file >= 0 && S_ISDIR(about.st_mode)) {
        close(file);
        errno = EISDIR;
        return -1;
    }
    *size = about.st_size;
    return file;
}

struct event_log *event_log_open(const char *path, size_t keep, char *error, size_t error_size)
{
    struct event_log *log = calloc(1, sizeof *log);

    if (log) {
        log->keep = keep;
        log->file = open_file(path, &log->size);
        if (log->file >= 0)
            return log;
    }
    snprintf(error, error_size, "%s: %s", strcmp(path, "-") == 0 ? "standard input" : path,
             strerror(errno));
    event_log_close(log);
    return NULL;
}

bool event_log_begins(const char *path)
{
    unsigned char found[MARK];
    struct stat status;
    int file;
    bool is_log;

    /* What is no file, such as a pipe, would be waited for. */
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode))
        return false;
    file = open(path, O_RDONLY | O_CLOEXEC);
    is_log = file >= 0 && read(file, found, MARK) == MARK && memcmp(found, mark, MARK) == 0;
    if (file >= 0)
        close(file);
    return is_log;
}

void event_log_close(struct event_log *log)
{
    if (!log)
        return;
    if (log->file >= 0)
        close(log->file);
    free(log->window);
    free(log);
}
