/* Which tip each sample is of, where nobody has said so. */
#ifndef REACH_LEARNER_FINDER_TIPS_H
#define REACH_LEARNER_FINDER_TIPS_H

#include "common/base/random.h"
#include "learner/finder/problem.h"

namespace finder
{

/* Samples that came as one tool's may be of several tools, in any order, and some of nothing at
 * all. A chain that was fitted to all of them as one tool is a compromise, but its frame is near
 * enough to tell them apart: behind it, each tool's samples lie about a point of their own. So
 * samples are given to the nearest of a few tips, those that are far from each are left out, and
 * the chain is solved anew, until nobody changes. True when what remains is explained to
 * `enough` times the noise; data and candidate are changed in that case alone. */
bool tell_tips_apart(Data &data, random_state &random, double enough, Candidate &candidate);

} // namespace finder

#endif
