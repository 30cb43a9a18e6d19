/* Whether robot states are of one robot, whose joints move no faster than they can. A state that is
 * not is not believed; while that is so the arm is to be held, and when it happens again and again
 * it is a fault. Plain data; used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_SENSES_PLAUSIBLE_H
#define REACH_DAEMON_CONTROL_SENSES_PLAUSIBLE_H

#include "daemon/config/config.h"
#include "daemon/config/sizes.h"
#include "daemon/control/senses/refusals.h"

#include <reach_robot_state_t.h>
#include <stdbool.h>
#include <stdint.h>

enum { PLAUSIBLE_MOST = 3 /* that often within a second is a fault */ };

/* The newest of something that happens: as many as are a fault. */
struct plausible_strikes {
    int64_t at[PLAUSIBLE_MOST]; /* us of senses.time; 0 = none */
    int newest;
};

struct plausible {
    const struct config *config;
    bool any;             /* a state was believed */
    int64_t utime;        /* of that one, us */
    double q[MAX_JOINTS]; /* rad */
    struct plausible_strikes jumps, crossings;
    struct plausible_strikes beyond; /* jumps out of the joint's range since a state was believed */
    struct state_fault jump;         /* the newest */
    double jumped;                   /* by how much, rad */
};

void plausible_init(struct plausible *plausible, const struct config *config);

/* The joints may be anywhere: a fault was reset. */
void plausible_forget(struct plausible *plausible);

/* So many states have crossed (senders.h) at `time`. The next state may be of another robot, or of
 * one that was begun anew: it is believed wherever it is. */
void plausible_crossed(struct plausible *plausible, int crossed, int64_t time);

/* Whether a joint is farther from where it was believed to be than its safety velocity allows in
 * the time between and safety.jump more; plausible->jump says which. `within`: the state is a good
 * one; else it has all joints, and a joint is out of its range. Such a state is nobody's unless no
 * good one comes any more: then an encoder has wrapped. */
bool plausible_strikes_jump(struct plausible *plausible, const reach_robot_state_t *state,
                            bool within, int64_t time);

/* Believes a good state. */
void plausible_believe(struct plausible *plausible, const reach_robot_state_t *state);

/* Whether what came lately is no ground to move on. */
bool plausible_doubts(const struct plausible *plausible, int64_t time);

/* Whether it happened so often that it is a fault: two senders, a joint that jumps. */
bool plausible_two_senders(const struct plausible *plausible, int64_t time);
bool plausible_jumps(const struct plausible *plausible, int64_t time);

#endif
