/* How often each channel speaks and how evenly, counted over windows of a second. Time is an
 * argument. */
#ifndef REACHCTL_VIEW_RATES_H
#define REACHCTL_VIEW_RATES_H

#include "common/bus/message_types.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RATES_MOST = 1000, RATES_NAME = 64 };

struct rate {
    char channel[RATES_NAME];        /* LCM's longest name fits */
    const struct message_type *type; /* of the newest message; NULL = none of ours */
    int64_t last;                    /* when the newest message came, us */
    int64_t longest;                 /* between two messages, since the channel is known; us */
    int64_t messages, bytes;         /* in the window that is open */
    int64_t intervals;               /* between messages in that window */
    double sum, squares;             /* of these intervals, us */
    double per_second;               /* of the window that was closed last, like the next two */
    double bytes_per_second;
    double jitter; /* standard deviation of the intervals, us; 0 with less than two */
};

/* All zero is a fresh one. */
struct rates {
    int n;
    int64_t uncounted;            /* messages of channels beyond the RATES_MOST first */
    int64_t opened;               /* when the window began, us; 0 = with the first message */
    struct rate rate[RATES_MOST]; /* in the order of the channels' names */
};

/* A message came at `now`, in us of a clock that never steps. */
void rates_count(struct rates *rates, const char *channel, const void *data, size_t bytes,
                 int64_t now);

/* Closes the window when it is a second old.
 *   returns how many seconds it was open, 0 when it stays so */
double rates_settle(struct rates *rates, int64_t now);

#endif
