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

/* rms distance of what was seen from its middle, in the units of the candidate. */
double length_of(const Data &data, const Candidate &candidate);

/* How many times the noise that was told the samples' noise is, where it is far more and the
 * candidate explains them nevertheless: what is left of neighbours in the joint space has nothing
 * in common then. 1 where that is not seen: what a wrong chain leaves goes with the posture. */
double noise_factor(const Data &data, const Candidate &candidate);

/* Fills the body's covariance, with noise `scale` times the settings', and returns its doubt: the
 * standard deviation of a tip over the range that the joints went through, rms, in units of length,
 * or a tenth of that over the range that the robot may use, whichever is more. */
double judge(const Data &data, double scale, random_state &random, Candidate &candidate);

/* How far what two candidates say lies apart over the range that samples went through, rms, in
 * units of length; infinite where one of them sees nothing in most of it. */
double distance(const Data &data, const Candidate &one, const Candidate &other);

} // namespace finder

#endif
