#include "daemon/bus/outgoing.h"

#include "common/base/checksum.h"

#include <stdio.h>
#include <string.h>

static const char *const channels[OUTGOING_KINDS] = {"ROBOT_COMMAND", "REACH_SAMPLE",
                                                     "REACH_STATUS", "REACH_TRACE"};

const char *outgoing_channel(enum outgoing_kind kind)
{
    return channels[kind];
}

const lcm_type_info_t *outgoing_type(enum outgoing_kind kind)
{
    switch (kind) {
    case OUTGOING_COMMAND:
        return reach_robot_command_t_get_type_info();
    case OUTGOING_SAMPLE:
        return reach_sample_t_get_type_info();
    case OUTGOING_STATUS:
        return reach_status_t_get_type_info();
    default:
        return reach_trace_t_get_type_info();
    }
}

void outgoing_init(struct outgoing_messages *messages, lcm_t *lcm, const char *prefix)
{
    memset(messages, 0, sizeof *messages);
    messages->lcm = lcm;
    messages->prefix = prefix;
    for (int kind = 0; kind < OUTGOING_KINDS; kind++)
        messages->type[kind] = outgoing_type((enum outgoing_kind)kind);
}

size_t outgoing_trace_covered(void)
{
    return (size_t)reach_trace_t_encoded_size(&(reach_trace_t){0}) - sizeof(int32_t);
}

/* In lockstep a command may go out again, after its own trace: it is none of the next tick. */
static void close_tick(struct outgoing_messages *messages, reach_trace_t *trace)
{
    uint32_t *checksum = messages->checksum;

    if (messages->command_seq == trace->seq)
        trace->command_checksum = (int32_t)checksum[OUTGOING_COMMAND];
    trace->sample_checksum = (int32_t)checksum[OUTGOING_SAMPLE];
    trace->status_checksum = (int32_t)checksum[OUTGOING_STATUS];
    memset(messages->checksum, 0, sizeof messages->checksum);
}

/* The last field, after all others are encoded. */
static void seal(unsigned char *bytes, size_t covered)
{
    uint32_t checksum = checksum_crc32(bytes, covered);

    for (int i = 0; i < 4; i++)
        bytes[covered + (size_t)i] = (unsigned char)(checksum >> (24 - 8 * i));
}

int outgoing_encode(struct outgoing_messages *messages, struct outgoing *out)
{
    const lcm_type_info_t *type = messages->type[out->kind];
    int size;

    if (out->kind == OUTGOING_TRACE)
        close_tick(messages, &out->trace);
    size = type->encode(messages->bytes, 0, OUTGOING_MOST_BYTES, &out->command);
    if (size < 0)
        return size; /* cannot be: the types are smaller */
    if (out->kind == OUTGOING_TRACE)
        seal(messages->bytes, (size_t)size - sizeof(int32_t));
    else
        messages->checksum[out->kind] = checksum_crc32(messages->bytes, (size_t)size);
    if (out->kind == OUTGOING_COMMAND)
        messages->command_seq = out->command.seq;
    return size;
}

void outgoing_publish(struct outgoing_messages *messages, struct outgoing *out)
{
    int size = outgoing_encode(messages, out);
    char channel[64];

    snprintf(channel, sizeof channel, "%s%s", messages->prefix, channels[out->kind]);
    if (size > 0)
        lcm_publish(messages->lcm, channel, messages->bytes, (unsigned)size);
}
