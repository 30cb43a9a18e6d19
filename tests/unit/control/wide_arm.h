/* An arm of an industrial one's ranges, whose body is to be found. */
#ifndef TESTS_UNIT_CONTROL_WIDE_ARM_H
#define TESTS_UNIT_CONTROL_WIDE_ARM_H

#include "daemon/config/config.h"
#include "learner/body/chain/chain.h"

#include <stdint.h>

/* Seven joints of a Franka's proportions, a little out of true. */
struct chain wide_arm(int64_t seed);

/* Its daemon's, with experts on a body; `noise` of what is measured, m. */
struct config wide_arm_config(double noise);

#endif
