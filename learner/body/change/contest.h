/* Whether a body that explains its samples badly is worth keeping: polynomials go on learning
 * beside it, and both foretell what neither has learned. An arm that bends like a trunk is
 * near a chain in few samples, and far from it in many. */
#ifndef REACH_LEARNER_BODY_CHANGE_CONTEST_H
#define REACH_LEARNER_BODY_CHANGE_CONTEST_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

struct contest {
    double rows;       /* samples since it began */
    double scored;     /* of which both have foretold */
    double polynomial; /* mean squared error, in units of the noise */
    double body;
};

struct contest contest_begin(void);

/* The next sample: whether nobody is to learn it, and whether it counts. A second of a walk is
 * withheld now and then, and the end of that is far enough from what was seen. */
bool contest_withholds(const struct contest *contest);
bool contest_counts(const struct contest *contest);

/* It has passed; where it counted, with these squared errors. */
void contest_add(struct contest *contest, double polynomial, double body);

/* Polynomials foretell clearly better. */
bool contest_lost(const struct contest *contest);

#ifdef __cplusplus
}
#endif
#endif
