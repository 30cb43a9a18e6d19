/* More babbling where reaching is poor (the paper's rule, section 5). When a target's time is over,
 * it was missed, and so were several of late, the arm babbles about where it is for a bounded
 * number of samples, goes back to where it began, and tries that target once more. Only while
 * learning. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_PRACTICE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_PRACTICE_H

#include "daemon/control/behaviours/babble.h"
#include "daemon/control/behaviours/targets.h"

struct practice {
    bool on;
    bool again;     /* the present target was practised for already */
    uint8_t missed; /* of the newest targets, the newest in bit 0 */
    struct babble babble;
    struct progress progress;
};

/* One tick, before that of the behaviour's targets.
 *   returns false when there is nothing to practise: the targets have the tick. */
bool practice_step(struct practice *practice, struct behaviour *behaviour, struct targets *targets,
                   const struct senses *senses, struct wants *wants);

#endif
