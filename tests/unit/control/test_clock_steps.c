/* The clock of the stamps is set, by an hour forth or back: no duration changes. */
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <reach_status_t.h>

static const int64_t hour = 3600 * (int64_t)1000000;
static const double timeout = 2; /* s */

/* The whole machine's, the robot's with it. */
static void set_clock(int64_t by)
{
    world.robot.now += by;
    world.robot.has_marker = false;
}

static void begin(void)
{
    const char *overrides[] = {"fixation.timeout=2", "babble.timeout=2"};

    world_begin(fixture_config(overrides, 2), 0);
    world.robot.now = 100 * hour;
    world_step();
}

/* Postures that a blind robot gives up in so many seconds, in which the clock is set once. */
static int skipped_in(double seconds, int64_t by)
{
    int ticks = (int)(seconds / 0.02);

    begin();
    world.robot.blind = true;
    world_ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 9, .seed = 1});
    for (int i = 0; i < ticks; i++) {
        if (i == 50)
            set_clock(by);
        world_step();
    }
    world_end();
    return world.outputs.status.skipped;
}

START_TEST(a_posture_is_given_up_as_soon_as_ever)
{
    int skipped = skipped_in(20 * timeout, 0);

    ck_assert_int_ge(skipped, 9);
    ck_assert_int_eq(skipped_in(20 * timeout, hour), skipped);
    ck_assert_int_eq(skipped_in(20 * timeout, -hour), skipped);
}
END_TEST

/* Ticks that two targets of two seconds take, the clock being set in the midst of the first. */
static int ticks_of_targets(int64_t by)
{
    reach_request_t request = {.kind = REACH_REQUEST_T_REACH, .n_targets = 2, .period = timeout};
    int ticks = 0;

    begin();
    world_ask(
        (reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 20, .seed = 1, .learn = 1});
    world_finish(20000);
    world_step();
    ck_assert_int_eq(world_ask(request), REACH_STATUS_T_ACCEPTED);
    while (world.outputs.status.phase != REACH_STATUS_T_TRACK)
        world_step();
    for (; world.outputs.status.behaviour != REACH_STATUS_T_NONE; ticks++) {
        if (ticks == 50)
            set_clock(by);
        ck_assert_int_lt(ticks, 1000);
        world_step();
    }
    world_end();
    return ticks;
}

START_TEST(targets_take_as_long_as_they_were_given)
{
    const int64_t steps[] = {0, hour, -hour, 3 * 1000000, -3 * 1000000};

    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
        ck_assert_int_le(abs(ticks_of_targets(steps[i]) - 200), 3);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_posture_is_given_up_as_soon_as_ever,
        targets_take_as_long_as_they_were_given,
    };

    return SUITE_RUN("clock_steps", tests);
}
