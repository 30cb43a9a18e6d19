#include "seed.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

struct random_state fixture_random(const char *test)
{
    const char *given = getenv("REACH_TEST_SEED");
    long long seed = given ? atoll(given) : (long long)time(NULL);

    printf("%s: REACH_TEST_SEED=%lld\n", test, seed);
    return random_seed(seed);
}
