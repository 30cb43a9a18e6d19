/* Who finds bodies for the store: reach-finder, over the bus. */
#ifndef REACH_LEARNER_BUS_FINDER_OF_BUS_H
#define REACH_LEARNER_BUS_FINDER_OF_BUS_H

#include "common/base/mailbox.h"
#include "learner/bus/body_answer.h"
#include "learner/bus/finder_channels.h"

#include <lcm/lcm.h>
#include <reach_body_request_t.h>
#include <reach_body_t.h>

struct finder_of_bus {
    struct finder_port port; /* what the store is given */

    /* From before the store's thread starts: */
    lcm_t *lcm;              /* to ask on; the caller's */
    struct mailbox *answers; /* struct received_body, that came on the asker's channel */
    enum finder_asker asker;

    /* The rest is that thread's: the newest request, to be sent again. */
    reach_body_request_t request;
    struct received_body received;
    reach_body_t told;
};

/* Before the store is created; `finder` must stay. */
void finder_of_bus_init(struct finder_of_bus *finder, enum finder_asker asker);

/* Frees the newest request. */
void finder_of_bus_end(struct finder_of_bus *finder);

#endif
