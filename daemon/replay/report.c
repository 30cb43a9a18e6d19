/* What a replay says of itself: counts, what is missing, and why it cannot go on. */
#include "daemon/replay/replay_private.h"

#include <stdarg.h>
#include <stdio.h>

const char *const replay_channels[REPLAY_CHANNELS] = {
    "ROBOT_STATE",  "MARKER",       "END_EFFECTOR", "REACH_REQUEST", "ROBOT_COMMAND",
    "REACH_SAMPLE", "REACH_STATUS", "REACH_TRACE",  "REACH_CONFIG",  "REACH_BODY",
};

const struct replay_report *replay_report(const struct replay *replay)
{
    return &replay->report;
}

int replay_fail(const struct replay *replay, char *error, size_t error_size, const char *format,
                ...)
{
    char what[REPLAY_REASON];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (replay->settings.lossy) /* the bus has no places */
        snprintf(error, error_size, "tick %lld: %s", (long long)replay->trace.seq, what);
    else
        snprintf(error, error_size, "byte %lld: tick %lld: %s", (long long)replay->position,
                 (long long)replay->trace.seq, what);
    return -1;
}

int replay_miss(struct replay *replay, enum replay_channel channel, int64_t first, int64_t n,
                const char *what, char *error, size_t error_size)
{
    int64_t run = replay->report.runs < REPLAY_RUNS ? replay->report.runs : REPLAY_RUNS;
    struct replay_lost *lost = &replay->report.run[run > 0 ? run - 1 : 0].lost[channel];

    if (!replay->settings.lossy)
        return replay_fail(replay, error, error_size, "%s %s %lld is not in the log", what,
                           replay_channels[channel], (long long)first);
    if (lost->n == 0)
        lost->first = first;
    lost->n += n;
    return 0;
}
