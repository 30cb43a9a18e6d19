/* Where the search begins. */
#ifndef REACH_LEARNER_FINDER_STARTS_H
#define REACH_LEARNER_FINDER_STARTS_H

#include "common/base/random.h"
#include "learner/finder/problem.h"

namespace finder
{

/* A chain that nothing is known of: random axes and lengths. */
Candidate random_start(const Data &data, random_state &random);

/* A body that somebody has given, in the problem's units. */
Candidate given_start(const Data &data, const struct body &body);

/* Joints that were turned alone from one posture: each draws a circle, which is its screw (a
 * straight line: a joint that slides). `seen` counts the joints that drew one; axes of the others
 * are random. */
Candidate circle_start(const Data &data, random_state &random, int *seen);

/* From the problem's units to those of the samples. */
struct body in_units(const Data &data, const Candidate &candidate);

} // namespace finder

#endif
