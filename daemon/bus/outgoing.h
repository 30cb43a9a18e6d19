/* Messages that the daemon sends, encoded once: the trace that follows a tick's other messages
 * names their checksums, so that a log shows whether they are still what went out. */
#ifndef REACH_DAEMON_BUS_OUTGOING_H
#define REACH_DAEMON_BUS_OUTGOING_H

#include <lcm/lcm.h>
#include <lcm/lcm_coretypes.h>
#include <reach_robot_command_t.h>
#include <reach_sample_t.h>
#include <reach_status_t.h>
#include <reach_trace_t.h>
#include <stdint.h>

enum outgoing_kind { OUTGOING_COMMAND, OUTGOING_SAMPLE, OUTGOING_STATUS, OUTGOING_TRACE };
enum { OUTGOING_KINDS = OUTGOING_TRACE + 1, OUTGOING_MOST_BYTES = 4096 };

struct outgoing {
    enum outgoing_kind kind;
    union {
        reach_robot_command_t command;
        reach_sample_t sample;
        reach_status_t status;
        reach_trace_t trace;
    };
};

/* Plain data; used by one thread. */
struct outgoing_messages {
    lcm_t *lcm;
    const char *prefix;                          /* of the channels */
    const lcm_type_info_t *type[OUTGOING_KINDS]; /* taken once: the generated calls are not safe
                                                    to be made by two threads */
    uint32_t checksum[OUTGOING_KINDS];           /* of what went out since the last trace */
    int64_t command_seq;                         /* of the command among it */
    unsigned char bytes[OUTGOING_MOST_BYTES];
};

/* The channel of each kind, and its type. */
const char *outgoing_channel(enum outgoing_kind kind);
const lcm_type_info_t *outgoing_type(enum outgoing_kind kind);

/* Sends on `lcm`, which stays the caller's, on channels whose names begin with `prefix`. */
void outgoing_init(struct outgoing_messages *messages, lcm_t *lcm, const char *prefix);

/* Encodes it into `bytes`, a trace with all checksums. Returns its size. */
int outgoing_encode(struct outgoing_messages *messages, struct outgoing *out);

/* Encodes and sends it. */
void outgoing_publish(struct outgoing_messages *messages, struct outgoing *out);

/* Bytes of an encoded trace that its own checksum is of; the checksum follows them. */
size_t outgoing_trace_covered(void);

#endif
