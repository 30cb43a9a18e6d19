/* Who stands still is found out; who only could not look accuses nobody. */
#include "common/base/random.h"
#include "daemon/config/sizes.h"
#include "daemon/realtime/stall.h"
#include "tests/unit/seed.h"
#include "tests/unit/suite.h"

#define PATIENCE 100000
#define PERIOD 20000

START_TEST(a_heartbeat_that_stops_is_seen_in_time)
{
    struct stall stall = {0};
    int64_t now = 5000000, beats = 0;

    for (int i = 0; i < 100; i++, now += PERIOD)
        ck_assert(!stall_seen(&stall, ++beats, PATIENCE, now));
    for (int i = 0; i < 5; i++, now += PERIOD)
        ck_assert(!stall_seen(&stall, beats, PATIENCE, now)); /* 100 ms since it moved: not over */
    ck_assert(stall_seen(&stall, beats, PATIENCE, now));
    ck_assert(stall_seen(&stall, beats, PATIENCE, now + PERIOD));
    ck_assert(!stall_seen(&stall, beats + 1, PATIENCE, now + 2 * PERIOD));
}
END_TEST

START_TEST(a_watch_that_was_stopped_itself_measures_anew)
{
    struct stall stall = {0};
    int64_t now = 5000000;

    stall_seen(&stall, 7, PATIENCE, now);
    now += 3 * 1000000; /* the whole process was stopped */
    ck_assert(!stall_seen(&stall, 7, PATIENCE, now));
    for (int i = 0; i < 5; i++)
        ck_assert(!stall_seen(&stall, 7, PATIENCE, now += PERIOD));
    ck_assert(stall_seen(&stall, 7, PATIENCE, now += PERIOD));
}
END_TEST

/* Looks that come as late as the machine lets them, by up to 0.4 periods. Returns how long after
 * the last beat the standstill is seen, us; -1 = not within 10 s. */
static int64_t seen_after(int64_t patience, struct random_state *random)
{
    struct stall stall = {0};
    int64_t now = 5000000, beats = 0;

    for (int i = 0; i < 50; i++, now += PERIOD + (int64_t)(random_bits(random) % (PERIOD * 2 / 5)))
        stall_seen(&stall, ++beats, patience, now);
    for (int64_t last = now; now < last + 10000000;
         now += PERIOD + (int64_t)(random_bits(random) % (PERIOD * 2 / 5)))
        if (stall_seen(&stall, beats, patience, now))
            return now - last;
    return -1;
}

/* Whatever the configuration lets pass arms the watchdog. */
START_TEST(a_standstill_is_seen_at_every_ratio_that_is_accepted)
{
    struct random_state random = fixture_random("test_stall");
    const double ratios[] = {STALL_LEAST_PERIODS, 3.01, 3.5, 4, 5, 7.3, 50};

    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++)
        for (int round = 0; round < 200; round++) {
            int64_t patience = (int64_t)(ratios[i] * PERIOD);
            int64_t seen = seen_after(patience, &random);
            ck_assert_msg(seen >= 0, "never seen at %g periods", ratios[i]);
            ck_assert_int_le(seen, patience + 3 * PERIOD);
        }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_heartbeat_that_stops_is_seen_in_time,
                                  a_watch_that_was_stopped_itself_measures_anew,
                                  a_standstill_is_seen_at_every_ratio_that_is_accepted};

    return SUITE_RUN("stall", tests);
}
