#include "fixture.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

struct config fixture_config(const char *const *overrides, int n_overrides)
{
    const char *source = getenv("REACH_SOURCE_DIR");
    struct config config;
    char path[512];
    char error[512];

    snprintf(path, sizeof path, "%s/etc/kobian.yaml", source ? source : ".");
    ck_assert_msg(config_load(&config, path, overrides, n_overrides, error, sizeof error) == 0,
                  "%s", error);
    return config;
}

struct random_state fixture_random(const char *test)
{
    const char *given = getenv("REACH_TEST_SEED");
    long long seed = given ? atoll(given) : (long long)time(NULL);

    printf("%s: REACH_TEST_SEED=%lld\n", test, seed);
    return random_seed(seed);
}
