#include "daemon/replay/recording.h"

#include "common/base/big_endian.h"
#include "common/base/checksum.h"

#include <stdbool.h>
#include <string.h>

enum { SEQ_AT = 16, SEQ_END = SEQ_AT + 8 };

void recording_add(struct recording *recording, const void *data, size_t size, int64_t position)
{
    struct recorded *recorded = &recording->message[recording->n % RECORDING_LENGTH];

    if (size < SEQ_END || size > RECORDED_MOST)
        return;
    recorded->seq = (int64_t)big_endian((const unsigned char *)data + SEQ_AT, 8);
    recorded->position = position;
    recorded->checksum = checksum_crc32(data, size);
    recorded->size = size;
    memcpy(recorded->bytes, data, size);
    recording->n++;
}

static const struct recorded *newest(const struct recording *recording, int64_t seq, bool any,
                                     uint32_t checksum)
{
    for (int64_t i = recording->n - 1; i >= 0 && i >= recording->n - RECORDING_LENGTH; i--) {
        const struct recorded *recorded = &recording->message[i % RECORDING_LENGTH];
        if (recorded->seq == seq && (any || recorded->checksum == checksum))
            return recorded;
    }
    return NULL;
}

const struct recorded *recording_find(const struct recording *recording, int64_t seq,
                                      uint32_t checksum)
{
    return newest(recording, seq, false, checksum);
}

const struct recorded *recording_numbered(const struct recording *recording, int64_t seq)
{
    return newest(recording, seq, true, 0);
}
