/* Random numbers of randomised tests. */
#ifndef TESTS_UNIT_SEED_H
#define TESTS_UNIT_SEED_H

#include "common/base/random.h"

/* From $REACH_TEST_SEED, else the time; it is printed under the test's name. */
struct random_state fixture_random(const char *test);

#endif
