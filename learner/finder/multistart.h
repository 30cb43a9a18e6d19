/* The best of many starts, and whether another one is as good. */
#ifndef REACH_LEARNER_FINDER_MULTISTART_H
#define REACH_LEARNER_FINDER_MULTISTART_H

#include "common/base/random.h"
#include "learner/finder/problem.h"

namespace finder
{

/* A place's misfit over the length of all, from a misfit in units of the noise. */
double relative(const Data &data, double error);

/* The misfit of a right chain is under this, in units of the noise. */
double near_truth(const Data &data);

/* The best of many starts; stops at the first whose misfit is that of the noise, told or not, or
 * when several have come to the same best. */
Candidate search(const Data &data, random_state &random, int *starts);

/* What further starts say against a candidate that explains the samples with this noise (in units
 * of the settings'), for its covariance knows nothing of other chains: how far one that explains
 * them as well is from it over the range that samples went through, rms, in units of length. 0 when
 * half as many starts as a search may make came to none. One that is better takes its place. */
double rivalry(const Data &data, double noise, random_state &random, Candidate &candidate);

} // namespace finder

#endif
