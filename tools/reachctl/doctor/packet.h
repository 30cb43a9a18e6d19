/* The head of an LCM packet on the wire (UDP multicast): who listens to the sockets beside LCM
 * learns who sends what. */
#ifndef REACH_TOOLS_REACHCTL_DOCTOR_PACKET_H
#define REACH_TOOLS_REACHCTL_DOCTOR_PACKET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PACKET_CHANNEL = 64 };

struct packet {
    char channel[PACKET_CHANNEL];
    const unsigned char *payload; /* within the data that was read */
    size_t payload_size;
    size_t
        message_size; /* of the whole message; greater than the payload when it is in fragments */
};

/* Reads a packet in which a message begins: a whole one, or the first fragment of a large one.
 *   returns false for other fragments and whatever is not LCM's */
bool packet_read(const unsigned char *data, size_t size, struct packet *packet);

/* The message's fingerprint, 0 when it has none. */
int64_t packet_fingerprint(const struct packet *packet);

#endif
