/* Messages that were refused, counted by channel and reason; whoever refuses one says so here.
 * Plain data. Channels and reasons are constants of status_t. */
#ifndef REACH_DAEMON_CONTROL_SENSES_REFUSALS_H
#define REACH_DAEMON_CONTROL_SENSES_REFUSALS_H

#include <reach_status_t.h>
#include <stdint.h>

enum {
    REFUSALS_CHANNELS = REACH_STATUS_T_CHANNEL_OUT + 1,
    REFUSALS_REASONS = REACH_STATUS_T_JUMP + 1,
};

/* What is wrong with a robot state. */
struct state_fault {
    int joint; /* from 1; 0 = it is of no joint */
    double value, min, max;
};

struct refusals {
    int64_t count[REFUSALS_CHANNELS][REFUSALS_REASONS];
    int64_t state_seq; /* the newest robot state among them whose values were wrong, 0 = none */
    struct state_fault state;
};

static inline void refusals_add(struct refusals *refusals, int channel, int reason)
{
    refusals->count[channel][reason]++;
}

/* The newest robot state that was refused, into a status, */
static inline void refusals_name_state(const struct refusals *refusals, reach_status_t *status)
{
    status->refused_state = refusals->state_seq;
    status->refused_joint = refusals->state.joint;
    status->refused_value = refusals->state.value;
    status->refused_min = refusals->state.min;
    status->refused_max = refusals->state.max;
}

/* and out of one. */
static inline void refusals_take_state(const reach_status_t *status, struct refusals *refusals)
{
    refusals->state_seq = status->refused_state;
    refusals->state = (struct state_fault){status->refused_joint, status->refused_value,
                                           status->refused_min, status->refused_max};
}

/* Adds counts to those of a status, and to their sum. */
static inline void refusals_into_status(const int64_t count[REFUSALS_CHANNELS][REFUSALS_REASONS],
                                        reach_status_t *status)
{
    for (int channel = 0; channel < REFUSALS_CHANNELS; channel++)
        for (int reason = 0; reason < REFUSALS_REASONS; reason++) {
            status->refused[channel][reason] += count[channel][reason];
            status->bad_inputs += count[channel][reason];
        }
}

#endif
