/* `reach-log cut` and `repair`: events of a log into another log. */
#ifndef REACH_TOOLS_LOG_EXTRACT_H
#define REACH_TOOLS_LOG_EXTRACT_H

#include "common/logs/event_log.h"

#include <stddef.h>
#include <stdint.h>

struct extract_settings {
    double from, to; /* s after the log's first stamp, both included; from 0: from the beginning,
                      * even if the clock was set back; `to` < 0: to the end */
    const char *channels; /* pattern that a whole name matches, as lcm-logger knows it; NULL: all */
};

struct extract_report {
    int64_t taken, left; /* events */
    int64_t skipped;     /* bytes that are no event */
};

/* Writes the events that are asked for to a new file `path`, each to the byte as it was. A file
 * that is there is not overwritten. Returns 0, or -1 with one line in `error`; then no file is
 * left. */
int extract(struct event_log *log, const struct extract_settings *settings, const char *path,
            struct extract_report *report, char *error, size_t error_size);

#endif
