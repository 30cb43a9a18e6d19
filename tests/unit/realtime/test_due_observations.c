/* Lockstep takes exactly the markers that are due, whatever the bus does to their order. */
#include "daemon/realtime/due_observations.h"
#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"

static struct due_observations markers;

static void add(int64_t utime)
{
    due_observations_add(&markers, &(struct observation){.utime = utime});
}

static int64_t take_due(int64_t due)
{
    struct observation marker = {0};

    return due_observations_take(&markers, due, &marker) ? marker.utime : 0;
}

START_TEST(a_later_marker_does_not_stand_in_for_the_one_that_is_due)
{
    due_observations_init(&markers);
    ck_assert(due_observations_ready(&markers, 0));
    add(66);
    ck_assert(!due_observations_ready(&markers, 33));
    ck_assert_int_eq(take_due(33), 0);
    add(33);
    ck_assert(due_observations_ready(&markers, 33));
    ck_assert_int_eq(take_due(33), 33);
    ck_assert_int_eq(take_due(33), 0); /* 66 is not due yet */
    ck_assert_int_eq(take_due(66), 66);
}
END_TEST

START_TEST(repeats_are_ignored)
{
    due_observations_init(&markers);
    add(33);
    add(33);
    ck_assert_int_eq(take_due(40), 33);
    add(33);
    ck_assert_int_eq(take_due(40), 0);
    ck_assert(due_observations_ready(&markers, 33));
}
END_TEST

START_TEST(a_full_store_keeps_what_is_due_first)
{
    due_observations_init(&markers);
    for (int i = 2; i < TICK_MAX_OBSERVATIONS + 5; i++)
        add(33 * i);
    add(33);
    ck_assert(due_observations_ready(&markers, 33));
    for (int i = 1; i <= TICK_MAX_OBSERVATIONS; i++)
        ck_assert_int_eq(take_due(INT64_MAX), 33 * i);
    ck_assert_int_eq(take_due(INT64_MAX), 0);
}
END_TEST

/* Any order, with repeats: what is taken at each due time is the same. */
START_TEST(the_order_of_arrival_does_not_matter)
{
    struct random_state random = fixture_random("test_due_observations");

    for (int round = 0; round < 2000; round++) {
        int64_t order[] = {33, 66, 99, 133};
        due_observations_init(&markers);
        for (int i = 3; i > 0; i--) {
            int k = (int)(random_bits(&random) % (uint64_t)(i + 1));
            int64_t swapped = order[i];
            order[i] = order[k];
            order[k] = swapped;
        }
        for (int i = 0; i < 4; i++) {
            add(order[i]);
            add(order[random_bits(&random) % (uint64_t)(i + 1)]);
        }
        ck_assert_int_eq(take_due(66), 33);
        ck_assert_int_eq(take_due(66), 66);
        ck_assert_int_eq(take_due(66), 0);
        ck_assert_int_eq(take_due(133), 99);
        ck_assert_int_eq(take_due(133), 133);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_later_marker_does_not_stand_in_for_the_one_that_is_due,
        repeats_are_ignored,
        a_full_store_keeps_what_is_due_first,
        the_order_of_arrival_does_not_matter,
    };

    return SUITE_RUN("due markers", tests);
}
