/* Sending on one channel past LCM, for who must not wait: a socket of its own, a packet whose head
 * is made beforehand, and no lock, heap or buffer that is shared with anybody. Plain data; used by
 * one thread. */
#ifndef REACH_COMMON_BUS_DIRECT_H
#define REACH_COMMON_BUS_DIRECT_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { DIRECT_MOST = 1024 /* bytes of a packet: its head, the channel, the message */ };

struct bus_direct {
    int descriptor;
    struct sockaddr_in to;
    uint32_t number; /* of the next packet, as LCM counts them */
    size_t head;     /* bytes before the message */
    int64_t failed;  /* packets that the system did not take */
    unsigned char packet[DIRECT_MOST];
};

/* Opens it for messages on `channel` of the bus at `url`, as bus_url (open.h) gives it. Returns 0,
 * or -1 with one line in `error`: only a bus that is a multicast group (udpm://) can be sent to. */
int bus_direct_open(struct bus_direct *direct, const char *url, const char *channel, char *error,
                    size_t error_size);

/* Where the message is to be put, and the room that it has. */
static inline unsigned char *bus_direct_message(struct bus_direct *direct)
{
    return direct->packet + direct->head;
}

static inline size_t bus_direct_room(const struct bus_direct *direct)
{
    return DIRECT_MOST - direct->head;
}

/* Sends the first `size` bytes of it. Does not wait: what the system cannot take now is lost and
 * counted. */
void bus_direct_send(struct bus_direct *direct, size_t size);

void bus_direct_close(struct bus_direct *direct);

#endif
