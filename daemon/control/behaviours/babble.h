/* Random joint references, each followed by fixation (paper section 7.1): the behaviour's own work,
 * which practice (practice.h) does as well. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_BABBLE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_BABBLE_H

#include "common/base/random.h"
#include "daemon/control/behaviours/behaviour.h"

struct babble {
    struct random_state random;
    double min[MAX_JOINTS], max[MAX_JOINTS]; /* of the references, rad */
    double goal[MAX_JOINTS];                 /* rad */
    int64_t deadline;                        /* us */
};

/* Begins to babble between babble->min and babble->max, which are set. */
void babble_begin(struct babble *babble, int64_t seed, struct progress *progress,
                  const struct senses *senses, const struct wants *wants);

/* One tick of that, however many samples there are; `progress` counts. */
void babble_continue(struct babble *babble, struct progress *progress, const struct senses *senses,
                     struct wants *wants);

#endif
