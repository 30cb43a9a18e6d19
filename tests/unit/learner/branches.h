/* What tests of births by evidence learn: branches that are one bent surface, each a step above the
 * last. */
#ifndef REACH_TEST_LEARNER_BRANCHES_H
#define REACH_TEST_LEARNER_BRANCHES_H

#include "bed.h"

enum { BRANCHES_INPUTS = 3, BRANCHES_OUTPUTS = 2, BRANCHES_OUTLIERS = 5 };

static const double branches_tolerance = 0.02; /* sqrt(psi0) */
static const double branches_step = 0.5;       /* from branch to branch */

/* Cubic experts with births by evidence after BRANCHES_OUTLIERS outliers. */
struct learner_config branches_cubic(int capacity);

/* Inputs at random. */
void branches_draw(double *z);

/* The outputs x of a branch at z. Numbers between two whole ones are between two branches. */
void branches_value_at(const double *z, double branch, double *x);

/* Learns n samples of a branch at independent inputs; counts each result in counts[5], or NULL. */
void branches_teach(struct learner *learner, int n, double branch, int *counts);

int branches_experts(const struct learner *learner);

/* How far the nearest solution is from the branch, root mean square, always at the same inputs. */
double branches_error_of(struct learner *learner, double branch);

#endif
