#include "tools/reachctl/doctor/packet.h"

#include "common/base/big_endian.h"

#include <string.h>

/* From LCM's description of its protocol: magic number, sequence number; a fragment goes on with
 * the message's size, its own offset, and its number and their count in 16 bits each. */
enum { MAGIC_WHOLE = 0x4c433032, MAGIC_FRAGMENT = 0x4c433033, WHOLE_HEAD = 8, FRAGMENT_HEAD = 20 };

bool packet_read(const unsigned char *data, size_t size, struct packet *packet)
{
    size_t head;
    size_t length;
    bool fragment;

    if (size < WHOLE_HEAD)
        return false;
    fragment = big_endian(data, 4) == MAGIC_FRAGMENT;
    head = fragment ? FRAGMENT_HEAD : WHOLE_HEAD;
    if ((!fragment && big_endian(data, 4) != MAGIC_WHOLE) || size < head ||
        (fragment && big_endian(data + 16, 2) != 0))
        return false;
    length = strnlen((const char *)data + head, size - head);
    if (length == size - head || length >= PACKET_CHANNEL)
        return false;
    memcpy(packet->channel, data + head, length + 1);
    packet->payload = data + head + length + 1;
    packet->payload_size = size - head - length - 1;
    packet->message_size = fragment ? (size_t)big_endian(data + 8, 4) : packet->payload_size;
    return true;
}

int64_t packet_fingerprint(const struct packet *packet)
{
    return packet->payload_size >= 8 ? (int64_t)big_endian(packet->payload, 8) : 0;
}
