#include "common/bus/direct.h"

#include "common/bus/multicast.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* Of a message that is not in fragments: magic number and number of the packet, 4 bytes each. */
enum { MAGIC = 0x4c433032, AT_NUMBER = 4, AT_CHANNEL = 8 };

static void put_word(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(word >> (24 - 8 * i));
}

static int open_socket(int ttl)
{
    int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);

    if (descriptor >= 0 &&
        setsockopt(descriptor, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl) != 0) {
        close(descriptor);
        return -1;
    }
    return descriptor;
}

int bus_direct_open(struct bus_direct *direct, const char *url, const char *channel, char *error,
                    size_t error_size)
{
    struct multicast bus;

    *direct = (struct bus_direct){.descriptor = -1, .head = AT_CHANNEL + strlen(channel) + 1};
    if (multicast_parse(url, &bus) || direct->head >= DIRECT_MOST) {
        snprintf(error, error_size, "%.200s is no multicast group (udpm://)", url);
        return -1;
    }
    direct->descriptor = open_socket(bus.ttl);
    if (direct->descriptor < 0) {
        snprintf(error, error_size, "no socket to %s: %s", bus.group, strerror(errno));
        return -1;
    }
    direct->to = bus.address;
    put_word(direct->packet, MAGIC);
    memcpy(direct->packet + AT_CHANNEL, channel, strlen(channel) + 1);
    return 0;
}

void bus_direct_send(struct bus_direct *direct, size_t size)
{
    put_word(direct->packet + AT_NUMBER, direct->number++);
    if (sendto(direct->descriptor, direct->packet, direct->head + size, MSG_DONTWAIT | MSG_NOSIGNAL,
               (const struct sockaddr *)&direct->to, sizeof direct->to) < 0)
        direct->failed++;
}

void bus_direct_close(struct bus_direct *direct)
{
    if (direct->descriptor >= 0)
        close(direct->descriptor);
    direct->descriptor = -1;
}
