/* The newest messages of one channel of a recorded run, for whoever looks for the one that a tick
 * was given or sent. Plain data. All of our messages begin with fingerprint, utime and seq. */
#ifndef REACH_DAEMON_REPLAY_RECORDING_H
#define REACH_DAEMON_REPLAY_RECORDING_H

#include <stddef.h>
#include <stdint.h>

enum { RECORDING_LENGTH = 256, RECORDED_MOST = 2048 };

struct recorded {
    int64_t seq;
    int64_t position; /* in the log, bytes */
    uint32_t checksum;
    size_t size;
    unsigned char bytes[RECORDED_MOST];
};

struct recording {
    int64_t n; /* messages so far */
    struct recorded message[RECORDING_LENGTH];
};

/* Keeps a copy. What is too short for a number or too long for a message of ours is none. */
void recording_add(struct recording *recording, const void *data, size_t size, int64_t position);

/* The message with this number and checksum; NULL when it is not here. */
const struct recorded *recording_find(const struct recording *recording, int64_t seq,
                                      uint32_t checksum);

/* The newest message with this number, whatever is in it. */
const struct recorded *recording_numbered(const struct recording *recording, int64_t seq);

#endif
