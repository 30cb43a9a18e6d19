#include "common/bus/multicast.h"

#include <arpa/inet.h>
#include <net/if.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

int multicast_parse(const char *url, struct multicast *bus)
{
    const char *ttl = strstr(url, "ttl=");
    int port = 7667;

    memset(bus, 0, sizeof *bus);
    snprintf(bus->group, sizeof bus->group, "239.255.76.67");
    if (strncmp(url, "udpm://", strlen("udpm://")) != 0)
        return -1;
    sscanf(url, "udpm://%15[0-9.]:%d", bus->group, &port);
    if (port < 1 || port > 65535 || inet_pton(AF_INET, bus->group, &bus->address.sin_addr) != 1 ||
        !IN_MULTICAST(ntohl(bus->address.sin_addr.s_addr)))
        return -1;
    bus->address.sin_family = AF_INET;
    bus->address.sin_port = htons((uint16_t)port);
    bus->ttl = ttl ? atoi(ttl + strlen("ttl=")) : 0;
    return 0;
}

static bool reachable(const struct multicast *bus)
{
    int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    bool connected = descriptor >= 0 && connect(descriptor, (const struct sockaddr *)&bus->address,
                                                sizeof bus->address) == 0;

    if (descriptor >= 0)
        close(descriptor);
    return connected;
}

int multicast_route(const struct multicast *bus, char *interface)
{
    FILE *table = fopen("/proc/net/route", "r");
    char line[256];
    char name[IF_NAMESIZE];
    in_addr_t narrowest = 0; /* masks, in network order as the kernel prints them */
    unsigned int destination;
    unsigned int mask;

    snprintf(interface, IF_NAMESIZE, "?");
    if (!table)
        return reachable(bus) ? 0 : -1;
    while (fgets(line, sizeof line, table))
        if (sscanf(line, "%15s %x %*x %*x %*d %*d %*d %x", name, &destination, &mask) == 3 &&
            (bus->address.sin_addr.s_addr & mask) == destination &&
            ntohl(mask) >= ntohl(narrowest)) {
            narrowest = mask;
            snprintf(interface, IF_NAMESIZE, "%s", name);
        }
    fclose(table);
    return reachable(bus) ? 0 : -1;
}

int multicast_listen(const struct multicast *bus)
{
    int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    struct ip_mreq membership = {.imr_multiaddr = bus->address.sin_addr};
    int one = 1;

    if (descriptor < 0)
        return -1;
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEPORT, &one, sizeof one); /* as LCM's have it */
    if (bind(descriptor, (const struct sockaddr *)&bus->address, sizeof bus->address) ||
        setsockopt(descriptor, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership)) {
        close(descriptor);
        return -1;
    }
    return descriptor;
}
