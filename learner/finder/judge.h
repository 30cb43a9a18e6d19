/* Whether a candidate is to be believed. */
#ifndef REACH_LEARNER_FINDER_JUDGE_H
#define REACH_LEARNER_FINDER_JUDGE_H

#include "common/base/random.h"
#include "learner/finder/problem.h"

namespace finder
{

/* Root mean square of what is left, in units of the noise, over the samples that are kept apart or
 * over the others; 1e9 where the eyes cannot see. The worst `gross` of them are left out: sensors
 * err. */
double misfit(const Data &data, const Candidate &candidate, bool apart, double gross = 0.1);

/* Fills the body's covariance, with noise `scale` times the settings', and returns its doubt: the
 * standard deviation of a tip over the range of the joints, rms, in units of length. */
double judge(const Data &data, double scale, random_state &random, Candidate &candidate);

} // namespace finder

#endif
