/* The gate: whatever comes in, what goes out keeps every limit. */
#include "daemon/control/limits/safety.h"
#include "fixture.h"
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

enum { LATE = 1 }; /* periods, of measurement and command each: within safety.latency together */

/* Joints whose motors and encoders lag behind. */
struct late_robot {
    double q[LATE + 1][MAX_JOINTS], command[LATE + 1][MAX_JOINTS]; /* newest first */
    int measured, obeyed; /* which of them is seen, which is in force */
};

/* A lag by chance; nothing older is seen or obeyed than was before. */
static int lag(struct random_state *random, int now)
{
    int most = now < LATE ? now + 1 : LATE;

    return (int)(random_bits(random) % (uint64_t)(most + 1));
}

static void late_robot_step(struct late_robot *robot, const double *command, double period)
{
    memmove(robot->command[1], robot->command[0], LATE * sizeof robot->command[0]);
    memmove(robot->q[1], robot->q[0], LATE * sizeof robot->q[0]);
    memcpy(robot->command[0], command, sizeof robot->command[0]);
    for (int i = 0; i < 6; i++)
        robot->q[0][i] += robot->command[robot->obeyed][i] * period;
}

/* Not ck_assert: Check writes each one that holds to a pipe, here millions. */
static void assert_limits(const struct config *config, const double *q, const double *velocity,
                          const double *before, long tick)
{
    for (int i = 0; i < 6; i++) {
        struct joint_limits limits = config_joint_limits(config, i);
        if (!(fabs(velocity[i]) <= limits.safety_velocity) ||
            !(fabs(velocity[i] - before[i]) <=
              limits.safety_acceleration * config->period + 1e-9) ||
            !(q[i] >= limits.min - 1e-9) || !(q[i] <= limits.max + 1e-9))
            ck_abort_msg("joint %d at %g, velocity %g after %g, after %ld ticks", i, q[i],
                         velocity[i], before[i], tick);
    }
}

/* Two hours of random wishes. The lag of measurements changes by chance, some are lost for a
 * second; that of the motors changes every `constant` ticks. */
static void wish_at_random(int constant)
{
    struct config config = fixture_config(NULL, 0);
    struct random_state random = fixture_random("test_safety");
    struct late_robot robot = {.obeyed = LATE};
    struct safety safety;
    double q[MAX_JOINTS], velocity[MAX_JOINTS], held[MAX_JOINTS] = {0}, before[MAX_JOINTS] = {0};

    safety_init(&safety, &config);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k <= LATE; k++)
            robot.q[k][i] =
                0.5 * (config_joint_limits(&config, i).min + config_joint_limits(&config, i).max);
    for (long tick = 0; tick < 2 * 3600 * 50; tick++) {
        for (int i = 0; i < 6 && tick % 25 == 0; i++)
            held[i] = wild(&random);
        if (tick % constant == constant - 1)
            robot.obeyed = lag(&random, robot.obeyed);
        robot.measured = lag(&random, robot.measured);
        if (tick % 200 < 150) {
            memcpy(q, robot.q[robot.measured], sizeof q);
            safety_measured(&safety);
        }
        memcpy(velocity, held, sizeof velocity);
        safety_gate(&safety, q, velocity);
        late_robot_step(&robot, velocity, config.period);
        assert_limits(&config, robot.q[0], velocity, before, tick);
        memcpy(before, velocity, sizeof before);
    }
    ck_assert_int_gt(safety.changed, 0);
}

START_TEST(no_wish_passes_a_limit_on_a_robot_that_lags)
{
    wish_at_random(2 * 3600 * 50);
}
END_TEST

/* A lag that grows makes a motor obey an older, faster command once more. */
START_TEST(no_wish_passes_a_limit_on_a_robot_whose_lag_jumps)
{
    wish_at_random(1);
}
END_TEST

/* Now and then the last command holds for the whole time of reaction, then the watchdog brakes. */
START_TEST(no_wish_passes_a_limit_when_the_loop_stands_still)
{
    struct config config = fixture_config(NULL, 0);
    struct random_state random = fixture_random("test_safety");
    struct safety safety;
    double q[MAX_JOINTS], velocity[MAX_JOINTS], before[MAX_JOINTS] = {0};
    int still = (int)(config.safety_reaction / config.period + 0.5);

    safety_init(&safety, &config);
    for (int i = 0; i < 6; i++)
        q[i] = 0.5 * (config_joint_limits(&config, i).min + config_joint_limits(&config, i).max);
    for (long tick = 0; tick < 2 * 3600 * 50; tick++) {
        bool stands = random_bits(&random) % 50 == 0;
        safety_measured(&safety);
        for (int i = 0; i < 6; i++)
            velocity[i] = tick / 25 % 2 ? 10 : -10;
        safety_gate(&safety, q, velocity);
        for (int i = 0; i < 6; i++)
            q[i] += velocity[i] * config.period * (stands ? 1 + still : 1);
        assert_limits(&config, q, velocity, before, tick);
        memcpy(before, velocity, sizeof before);
        while (stands && !safety_at_rest(before)) {
            safety_was_braked(&safety, 1);
            safety_brake(&config, before);
            for (int i = 0; i < 6; i++)
                q[i] += before[i] * config.period;
            assert_limits(&config, q, before, before, tick);
        }
    }
}
END_TEST

START_TEST(before_a_limit_the_acceleration_suffices)
{
    struct config config = fixture_config(NULL, 0);
    struct joint_limits limits = config_joint_limits(&config, 0);
    double q[MAX_JOINTS] = {limits.min, -0.3, 0, -1.1, 0, 0.1};
    struct safety safety;
    double before = 0, fastest = 0;

    safety_init(&safety, &config);
    for (int tick = 0; tick < 500; tick++) {
        double velocity[MAX_JOINTS] = {10};
        safety_measured(&safety);
        safety_gate(&safety, q, velocity);
        ck_assert_double_le(before - velocity[0],
                            limits.safety_acceleration * config.period + 1e-12);
        before = velocity[0];
        fastest = fmax(fastest, velocity[0]);
        q[0] += velocity[0] * config.period;
    }
    ck_assert_double_eq(fastest, limits.safety_velocity); /* where there is room, it is used */
    ck_assert(q[0] <= limits.max);
    ck_assert_double_ge(q[0], limits.max - 1e-3);
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
    safety_measured(&safety);
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
    safety_measured(&safety);
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
    safety_measured(&safety);
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
    const TTest *const tests[] = {no_wish_passes_a_limit_on_a_robot_that_lags,
                                  no_wish_passes_a_limit_on_a_robot_whose_lag_jumps,
                                  no_wish_passes_a_limit_when_the_loop_stands_still,
                                  before_a_limit_the_acceleration_suffices,
                                  a_good_command_passes_untouched,
                                  what_is_not_a_number_becomes_rest,
                                  beyond_a_limit_only_the_way_back_is_open};

    return SUITE_RUN("safety", tests);
}
