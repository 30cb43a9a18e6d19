/* Whether the robot states that come are of one sender, by their numbers and times. Pure; the tick
 * is told how many crossed (tick_inputs), since it does not see all that come. */
#ifndef REACH_DAEMON_CONTROL_SENSES_SENDERS_H
#define REACH_DAEMON_CONTROL_SENSES_SENDERS_H

#include <reach_robot_state_t.h>
#include <stdbool.h>
#include <stdint.h>

/* The most that messages of one sender overtake each other, us. */
#define SENDERS_OVERTAKEN 200000

struct senders {
    int64_t seq, utime; /* newest state looked at; 0 = none yet */
};

/* Looks at the next state, which is a good one. Of one sender, number and time go on together, or
 * go back together by a little when one state overtakes another; what comes twice is the same. True
 * when it is otherwise: once, a robot has begun anew or its clock was set back; again and again,
 * there are two. */
static inline bool senders_cross(struct senders *senders, const reach_robot_state_t *state)
{
    bool seq_back = state->seq <= senders->seq, utime_back = state->utime <= senders->utime;
    bool crosses = senders->seq > 0 &&
                   (seq_back != utime_back || state->utime < senders->utime - SENDERS_OVERTAKEN);

    if (seq_back && utime_back && !crosses)
        return false;
    senders->seq = state->seq;
    senders->utime = state->utime;
    return crosses;
}

#endif
