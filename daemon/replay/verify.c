/* What ticks sent, as it was recorded, against what they send now. */
#include "daemon/replay/replay_private.h"

#include "daemon/replay/compare.h"

#include <string.h>

static const enum replay_channel channel_of[OUTGOING_KINDS] = {REPLAY_COMMAND, REPLAY_SAMPLE,
                                                               REPLAY_STATUS, REPLAY_TRACE};

static const void *replayed_message(const struct tick_outputs *outputs, enum outgoing_kind kind)
{
    switch (kind) {
    case OUTGOING_COMMAND:
        return &outputs->command;
    case OUTGOING_SAMPLE:
        return &outputs->sample;
    case OUTGOING_STATUS:
        return &outputs->status;
    default:
        return &outputs->trace;
    }
}

static void put_message(struct outgoing *message, enum outgoing_kind kind, const void *from)
{
    const lcm_type_info_t *type = outgoing_type(kind);

    message->kind = kind;
    memcpy(&message->command, from, (size_t)type->struct_size());
}

/* Compares replay->recorded with replay->replayed. */
static int compare_message(struct replay *replay, enum outgoing_kind kind, char *error,
                           size_t error_size)
{
    char difference[REPLAY_REASON / 2];

    put_message(&replay->replayed, kind, replayed_message(&replay->outputs, kind));
    replay_take_measured(&replay->recorded, &replay->replayed);
    if (replay_same(&replay->recorded, &replay->replayed, difference, sizeof difference))
        return 0;
    return replay_fail(replay, error, error_size, "%s.%s", outgoing_channel(kind), difference);
}

static int decode(struct replay *replay, enum outgoing_kind kind, const struct recorded *found)
{
    int size = (int)found->size;

    replay->recorded.kind = kind;
    return outgoing_type(kind)->decode(found->bytes, 0, size, &replay->recorded.command) == size
               ? 0
               : -1;
}

/* One message of number `seq`, which was sent with this checksum. */
static int verify_message(struct replay *replay, enum outgoing_kind kind, int64_t seq,
                          int32_t checksum, char *error, size_t error_size)
{
    enum replay_channel channel = channel_of[kind];
    const struct recording *recording = &replay->recording[channel];
    const struct recorded *found = recording_find(recording, seq, (uint32_t)checksum);
    bool altered = !found;

    if (altered)
        found = recording_numbered(recording, seq);
    if (!found)
        return replay_miss(replay, channel, seq, 1, "it sent", error, error_size);
    if (decode(replay, kind, found))
        return replay_fail(replay, error, error_size,
                           "the %s at byte %lld cannot be read; the log was altered",
                           replay_channels[channel], (long long)found->position);
    if (compare_message(replay, kind, error, error_size))
        return -1;
    if (altered)
        return replay_fail(replay, error, error_size,
                           "the %s at byte %lld has another checksum than the one that was sent; "
                           "the log was altered",
                           replay_channels[channel], (long long)found->position);
    return 0;
}

/* A message that not every tick sends. */
static int verify_if_sent(struct replay *replay, enum outgoing_kind kind, bool sends, int64_t seq,
                          int32_t checksum, char *error, size_t error_size)
{
    if (sends != (checksum != 0))
        return replay_fail(replay, error, error_size, "%s: recorded %s, replayed %s",
                           outgoing_channel(kind), checksum ? "one" : "none",
                           sends ? "one" : "none");
    return sends ? verify_message(replay, kind, seq, checksum, error, error_size) : 0;
}

int replay_verify(struct replay *replay, char *error, size_t error_size)
{
    const struct tick_outputs *outputs = &replay->outputs;
    const reach_trace_t *trace = &replay->trace;

    if (verify_if_sent(replay, OUTGOING_COMMAND, outputs->has_command, trace->seq,
                       trace->command_checksum, error, error_size) ||
        verify_if_sent(replay, OUTGOING_SAMPLE, outputs->has_sample, outputs->sample.seq,
                       trace->sample_checksum, error, error_size) ||
        verify_message(replay, OUTGOING_STATUS, trace->seq, trace->status_checksum, error,
                       error_size))
        return -1;
    put_message(&replay->recorded, OUTGOING_TRACE, trace);
    return compare_message(replay, OUTGOING_TRACE, error, error_size);
}
