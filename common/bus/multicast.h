/* The multicast group behind an LCM address, without LCM. */
#ifndef REACH_COMMON_BUS_MULTICAST_H
#define REACH_COMMON_BUS_MULTICAST_H

#include <netinet/in.h>

#ifdef __cplusplus
extern "C" {
#endif

struct multicast {
    char group[INET_ADDRSTRLEN];
    struct sockaddr_in address;
    int ttl; /* hops that a packet may make; 0 = it stays on this machine */
};

/* Reads "udpm://group:port?ttl=N"; what is left out is as LCM has it. Returns 0, or -1 for an
 * address of another kind. */
int multicast_parse(const char *url, struct multicast *bus);

/* By which interface a packet to the group would leave, "?" where that cannot be told; `interface`
 * has room for IF_NAMESIZE.
 *   returns 0, or -1 when by none */
int multicast_route(const struct multicast *bus, char *interface);

/* A socket that receives every packet to the group, from anyone. Returns it or -1. */
int multicast_listen(const struct multicast *bus);

#ifdef __cplusplus
}
#endif

#endif
