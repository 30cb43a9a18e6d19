/* The gate: whatever comes in, what goes out keeps every limit. */
#include "fixture.h"
#include "safety.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <string.h>

/* A wish that a broken program might have. */
static double wild(struct random_state *random)
{
    switch (random_bits(random) % 8) {
    case 0:
        return NAN;
    case 1:
        return INFINITY;
    case 2:
        return -INFINITY;
    case 3:
        return random_uniform(random, -1e6, 1e6);
    default:
        return random_uniform(random, -3, 3);
    }
}

/* Hours of random wishes on joints that obey with a period's delay: no limit is ever passed. */
START_TEST(no_wish_passes_a_limit)
{
    struct config config = fixture_config(NULL, 0);
    struct random_state random = fixture_random("test_safety");
    struct safety safety;
    double q[MAX_JOINTS], before[MAX_JOINTS] = {0}, velocity[MAX_JOINTS];
    double held[MAX_JOINTS] = {0};

    safety_init(&safety, &config);
    for (int i = 0; i < 6; i++)
        q[i] = 0.5 * (config_joint_limits(&config, i).min + config_joint_limits(&config, i).max);
    for (long tick = 0; tick < 2 * 3600 * 50; tick++) {
        if (tick % 25 == 0)
            for (int i = 0; i < 6; i++)
                held[i] = wild(&random);
        memcpy(velocity, held, sizeof velocity);
        safety_gate(&safety, q, velocity);
        for (int i = 0; i < 6; i++) {
            struct joint_limits limits = config_joint_limits(&config, i);
            q[i] += before[i] * config.period; /* the command of a period ago */
            before[i] = velocity[i];
            /* Not ck_assert: Check writes each one that holds to a pipe, here millions. */
            if (!(fabs(velocity[i]) <= limits.safety_velocity) ||
                velocity[i] != safety.previous[i] || !(q[i] >= limits.min - 1e-3) ||
                !(q[i] <= limits.max + 1e-3))
                ck_abort_msg("joint %d at %g, velocity %g, after %ld ticks", i, q[i], velocity[i],
                             tick);
        }
    }
    ck_assert_int_gt(safety.changed, 0);
}
END_TEST

START_TEST(velocity_changes_no_faster_than_allowed)
{
    struct config config = fixture_config(NULL, 0);
    struct random_state random = fixture_random("test_safety");
    double q[MAX_JOINTS] = {0}, velocity[MAX_JOINTS], previous[MAX_JOINTS] = {0};
    struct safety safety;

    safety_init(&safety, &config);
    for (int i = 0; i < 6; i++)
        q[i] = 0.5 * (config_joint_limits(&config, i).min + config_joint_limits(&config, i).max);
    for (int tick = 0; tick < 100000; tick++) {
        for (int i = 0; i < 6; i++)
            velocity[i] = wild(&random);
        safety_gate(&safety, q, velocity);
        for (int i = 0; i < 6; i++) {
            double step = config_joint_limits(&config, i).safety_acceleration * config.period;
            /* In mid-range the limits of position do not interfere. */
            ck_assert(fabs(velocity[i] - previous[i]) <= step + 1e-9);
            previous[i] = velocity[i];
        }
    }
}
END_TEST

START_TEST(a_good_command_passes_untouched)
{
    struct config config = fixture_config(NULL, 0);
    double q[MAX_JOINTS] = {-1.1, -0.3, 0, -1.1, 0, 0.1};
    double velocity[MAX_JOINTS] = {0.1, -0.1, 0.05, 0.02, 0.2, -0.1};
    double wanted[MAX_JOINTS];
    struct safety safety;

    memcpy(wanted, velocity, sizeof wanted);
    safety_init(&safety, &config);
    ck_assert(!safety_gate(&safety, q, velocity));
    ck_assert_mem_eq(wanted, velocity, sizeof wanted);
    ck_assert_int_eq(safety.changed, 0);
}
END_TEST

START_TEST(what_is_not_a_number_becomes_rest)
{
    struct config config = fixture_config(NULL, 0);
    double q[MAX_JOINTS] = {-1.1, -0.3, 0, -1.1, 0, 0.1};
    double velocity[MAX_JOINTS] = {NAN, INFINITY, -INFINITY, NAN, -NAN, NAN};
    struct safety safety;

    safety_init(&safety, &config);
    ck_assert(safety_gate(&safety, q, velocity));
    for (int i = 0; i < 6; i++)
        ck_assert_double_eq(velocity[i], 0);
    ck_assert_int_eq(safety.changed, 1);
}
END_TEST

START_TEST(beyond_a_limit_only_the_way_back_is_open)
{
    struct config config = fixture_config(NULL, 0);
    double q[MAX_JOINTS] = {-1.1, -0.3, 0, -1.1, 0, 0.1};
    double velocity[MAX_JOINTS] = {0};
    struct safety safety;

    q[0] = config.arm_max.value[0] + 0.05;
    safety_init(&safety, &config);
    velocity[0] = 0.2;
    safety_gate(&safety, q, velocity);
    ck_assert_double_eq(velocity[0], 0);
    velocity[0] = -0.2;
    safety_gate(&safety, q, velocity);
    ck_assert_double_eq(velocity[0], -0.2);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {no_wish_passes_a_limit, velocity_changes_no_faster_than_allowed,
                                  a_good_command_passes_untouched,
                                  what_is_not_a_number_becomes_rest,
                                  beyond_a_limit_only_the_way_back_is_open};

    return SUITE_RUN("safety", tests);
}
