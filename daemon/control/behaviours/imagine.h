/* Reaching in the imagination: what the arm would do under the daemon's own law if the model were
 * the arm. From where the arm stands, and where that ends in a corner of the joints' range, from
 * postures anywhere. A joint that turns far has many ways to a place, and the straight one ends at
 * its stop.
 *
 * Takes a bounded share of a tick; plain data, used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_BEHAVIOURS_IMAGINE_H
#define REACH_DAEMON_CONTROL_BEHAVIOURS_IMAGINE_H

#include "common/base/random.h"
#include "daemon/control/behaviours/behaviour.h"

struct imagine {
    struct random_state random;
    double target[SPACE_DIMENSIONS]; /* task units */
    int attempt;                     /* 0 = from where the arm stands */
    int step;
    double q[MAX_JOINTS]; /* imagined, rad */
};

enum imagined {
    IMAGINED_NOT_YET,   /* goes on in the next tick */
    IMAGINED_STRAIGHT,  /* the arm gets there from where it stands */
    IMAGINED_BY_JOINTS, /* imagine->q is a posture at the target, to be driven to first */
    IMAGINED_NOTHING,   /* no attempt got there */
};

/* What the model says at arm joints q (rad), as the context that is followed now has it; NULL when
 * it has nothing to say. Holds until the next call. */
const struct learner_solution *imagine_solution(const struct senses *senses, const double *q);

/* Begins to imagine the way to `target`. */
void imagine_begin(struct imagine *imagine, const double *target, const struct senses *senses);

/* The same, where the straight way was tried in vain. */
void imagine_detour(struct imagine *imagine, const double *target, const struct senses *senses);

/* One tick of that. */
enum imagined imagine_go_on(struct imagine *imagine, const struct senses *senses);

#endif
