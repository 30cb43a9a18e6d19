/* What health.c decides and tell.c puts into words. */
#ifndef REACH_LEARNER_HEALTH_JUDGE_H
#define REACH_LEARNER_HEALTH_JUDGE_H

#include "learner/health/health.h"

bool health_is_constant(const struct health *health, int input);

/* Fewer samples than that many experts would need. */
bool health_lacks_samples(const struct health *health, const struct learner_statistics *statistics);

/* Solutions of a prediction; NaN while too few were made. */
double health_mean_solutions(const struct health *health);

#endif
