/* Who stands still is found out; who only could not look accuses nobody. */
#include "daemon/realtime/stall.h"
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

int main(void)
{
    const TTest *const tests[] = {a_heartbeat_that_stops_is_seen_in_time,
                                  a_watch_that_was_stopped_itself_measures_anew};

    return SUITE_RUN("stall", tests);
}
