#include "daemon/replay/event_log.h"

#include "common/base/big_endian.h"

#include <string.h>

enum { HEADER = 28 }; /* sync 4, number 8, time 8, length of the channel 4, of the data 4 */

static const uint32_t sync_word = 0xeda1da01;
static const uint32_t most_data = 1u << 28; /* bytes; no message of LCM is larger */

static int cut(const struct event_log *log, char *error, size_t error_size)
{
    snprintf(error, error_size, "byte %lld: the log ends within this event",
             (long long)log->position);
    return -1;
}

/* Goes on without keeping what is read. */
static int skip(struct event_log *log, size_t size)
{
    while (size > 0) {
        size_t part = size < sizeof log->data ? size : sizeof log->data;
        if (fread(log->data, 1, part, log->file) != part)
            return -1;
        size -= part;
    }
    return 0;
}

static int read_body(struct event_log *log, size_t name, struct event *event)
{
    if (fread(log->channel, 1, name, log->file) != name)
        return -1;
    log->channel[name] = '\0';
    if (event->size > sizeof log->data)
        return skip(log, event->size);
    event->data = log->data;
    return fread(log->data, 1, event->size, log->file) == event->size ? 0 : -1;
}

int event_log_next(struct event_log *log, struct event *event, char *error, size_t error_size)
{
    unsigned char header[HEADER];
    size_t got = fread(header, 1, HEADER, log->file);
    uint32_t name, size;

    if (got == 0 && feof(log->file))
        return 0;
    if (got != HEADER)
        return cut(log, error, error_size);
    name = (uint32_t)big_endian(header + 20, 4);
    size = (uint32_t)big_endian(header + 24, 4);
    if (big_endian(header, 4) != sync_word || name == 0 || name >= EVENT_LOG_CHANNEL ||
        size > most_data) {
        snprintf(error, error_size, "byte %lld: this is no event of an LCM log",
                 (long long)log->position);
        return -1;
    }
    *event = (struct event){.channel = log->channel, .size = size, .position = log->position};
    if (read_body(log, name, event))
        return cut(log, error, error_size);
    log->position += (int64_t)HEADER + name + size;
    return 1;
}
