/* Reaching from nothing: no babbling, goals that the robot sets itself. Used by explore.c. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_EXPLORE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_EXPLORE_H

#include "common/base/random.h"
#include "daemon/config/sizes.h"
#include "daemon/config/space.h"

#include <stdbool.h>
#include <stdint.h>

struct explore {
    struct random_state random;

    /* What was visited: a box in task space. Goals lie in it, and a little beyond. */
    bool any;
    double low[SPACE_DIMENSIONS], high[SPACE_DIMENSIONS];
    double q_seen[MAX_JOINTS]; /* where the end-effector was last seen well, rad */

    double goal[SPACE_DIMENSIONS]; /* task units */
    double posture[MAX_JOINTS];    /* that the null space goes to meanwhile, rad */
    double nearest;                /* to the goal so far, scaled */
    int64_t nearest_at;            /* us */

    double noise[MAX_JOINTS]; /* present direction, -1 .. 1 */
    int64_t noise_until;      /* us */

    /* How wrong the model is about what moving does: share of the motion, 1 = knows nothing. */
    double ignorance;
    bool compared;                      /* `q` and the rest hold */
    double q[MAX_JOINTS];               /* arm joints of the last sample, rad */
    double x_before[SPACE_DIMENSIONS];  /* where the comparison began */
    double predicted[SPACE_DIMENSIONS]; /* how far it should have moved since, task units */
};

#endif
