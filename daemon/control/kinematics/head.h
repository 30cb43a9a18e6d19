/* The head: fixation (eq. 11) and the stereotyped search for a marker that is out of view. */
#ifndef REACH_DAEMON_CONTROL_KINEMATICS_HEAD_H
#define REACH_DAEMON_CONTROL_KINEMATICS_HEAD_H

#include "common/base/random.h"
#include "daemon/config/config.h"
#include "daemon/config/space.h"

#include <stdint.h>

#define HEAD_JOINTS 2 /* yaw, pitch */

/* Equation 11: head velocities (rad/s) that bring the marker at `image` (px) to the centre. */
void head_fixate(const struct config *config, const double image[SPACE_DIMENSIONS],
                 double velocity[HEAD_JOINTS]);

/* Head velocities (rad/s) that turn the head at q (rad) to `goal` by its encoders. */
void head_turn(const struct config *config, const double *q, const double *goal,
               double velocity[HEAD_JOINTS]);

/* The search: random left-right and up-down movements (paper section 5.2.1), with a rest at each
 * place so that the eyes, which are late, can see it. */
struct head_search {
    struct random_state random;
    bool active;
    int64_t rest_until; /* us; 0 = still turning */
    double goal[HEAD_JOINTS];
};

void head_search_init(struct head_search *search, int64_t seed);

/* One period of the search from the head at q (rad). */
void head_search_step(struct head_search *search, const struct config *config, int64_t now,
                      const double *q, double velocity[HEAD_JOINTS]);

/* The marker is back: the next search starts anew. */
void head_search_end(struct head_search *search);

#endif
