/* Who finds bodies for the store: reach-finder, over the bus. */
#ifndef REACH_DAEMON_FINDER_OF_BUS_H
#define REACH_DAEMON_FINDER_OF_BUS_H

#include "daemon/bus/bus.h"
#include "learner/store/finder_port.h"

struct finder_of_bus {
    struct finder_port port; /* what the store is given */
    struct daemon_bus *bus;  /* from before the store's thread starts */

    /* The rest is that thread's: the newest request, to be sent again. */
    reach_body_request_t request;
    struct received_body received;
    reach_body_t told;
};

/* Before the store is created; `finder` must stay. */
void finder_of_bus_init(struct finder_of_bus *finder);

/* Frees the newest request. */
void finder_of_bus_end(struct finder_of_bus *finder);

#endif
