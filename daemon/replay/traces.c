/* The traces of a log that were logged twice, are of other programs, or begin a run. */
#include "daemon/replay/replay_private.h"

#include <stdio.h>

bool replay_is_repeated(struct replay *replay)
{
    struct replay_traces *traces = &replay->traces;
    const reach_trace_t *trace = &replay->trace;
    int known = traces->n < REPLAY_NEWEST ? (int)traces->n : REPLAY_NEWEST;

    for (int i = 0; i < known; i++)
        if (traces->newest[i].seq == trace->seq && traces->newest[i].checksum == trace->checksum) {
            replay->report.repeated++;
            return true;
        }
    traces->newest[traces->n % REPLAY_NEWEST] =
        (struct replay_trace_id){trace->seq, trace->checksum};
    traces->n++;
    return false;
}

bool replay_begins_run(struct replay *replay)
{
    struct replay_traces *traces = &replay->traces;
    const reach_trace_t *trace = &replay->trace;
    bool begins = !replay->tick || trace->seq <= replay->seq || (trace->fresh && traces->worked);

    traces->worked = (traces->worked && !begins) || !trace->fresh;
    return begins;
}

void replay_note_foreign(struct replay *replay, enum replay_channel channel, int64_t position)
{
    struct replay_foreign *foreign = &replay->foreign[channel == REPLAY_CONFIG];

    if (channel == REPLAY_TRACE)
        replay->report.foreign++;
    foreign->any = true;
    foreign->position = position;
}

int replay_another_version(const struct replay *replay, enum replay_channel channel, char *error,
                           size_t error_size)
{
    snprintf(error, error_size,
             "byte %lld: this %s is of another version of reachd's messages, or of another "
             "program; the version that made the log can replay it",
             (long long)replay->foreign[channel == REPLAY_CONFIG].position,
             replay_channels[channel]);
    return -1;
}

/* Whether a tick sent its status, and its trace was not understood. */
static bool last_trace_is_missing(const struct replay *replay)
{
    const struct recording *status = &replay->recording[REPLAY_STATUS];

    return replay->foreign[0].any && status->n > 0 &&
           status->message[(status->n - 1) % RECORDING_LENGTH].seq > replay->seq;
}

int replay_end(const struct replay *replay, char *error, size_t error_size)
{
    if (last_trace_is_missing(replay) || (replay->report.ticks == 0 && replay->foreign[0].any))
        return replay_another_version(replay, REPLAY_TRACE, error, error_size);
    if (replay->report.ticks > 0)
        return 0;
    snprintf(error, error_size, "there is no REACH_TRACE in it, so there is nothing to replay");
    return -1;
}
