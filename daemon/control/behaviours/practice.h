/* More babbling where reaching is poor (the paper's rule, section 5). When a target's time is over,
 * it was missed, and so were several of late, the arm babbles about where it is for a bounded
 * number of samples, goes back to where it began, and tries that target once more. Only while
 * learning. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_PRACTICE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_PRACTICE_H

#include "daemon/control/behaviours/behaviour.h"

/* One tick, before the targets'.
 *   returns false when there is nothing to practise: the targets have the tick. */
bool practice_step(struct behaviour *behaviour, struct control *control);

#endif
