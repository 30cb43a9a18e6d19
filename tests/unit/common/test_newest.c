/* The newest record between two threads: never torn, never an older one after a newer one, and the
 * last one arrives. */
#include "common/base/newest.h"
#include "tests/unit/suite.h"

#include <pthread.h>
#include <stdint.h>

#define RECORDS 300000

struct record {
    uint64_t number, twice, thrice;
};

START_TEST(what_was_not_taken_is_replaced)
{
    struct arena *arena = arena_create(newest_memory(sizeof(int)));
    struct newest *newest = newest_create(arena, sizeof(int));
    int value = 0;

    ck_assert_ptr_nonnull(newest);
    ck_assert(!newest_take(newest, &value));
    for (int round = 0; round < 5; round++) {
        for (int i = 0; i <= round; i++)
            newest_put(newest, &(int){100 * round + i});
        ck_assert(newest_take(newest, &value));
        ck_assert_int_eq(value, 101 * round);
        ck_assert(!newest_take(newest, &value));
    }
    arena_destroy(arena);
}
END_TEST

static void *put_all(void *user)
{
    for (uint64_t i = 1; i <= RECORDS; i++) {
        struct record record = {i, 2 * i, 3 * i};
        newest_put(user, &record);
    }
    return NULL;
}

START_TEST(between_two_threads_the_last_one_arrives_whole)
{
    struct arena *arena = arena_create(newest_memory(sizeof(struct record)));
    struct newest *newest = newest_create(arena, sizeof(struct record));
    struct record record = {0};
    uint64_t before = 0;
    pthread_t writer;

    ck_assert_int_eq(pthread_create(&writer, NULL, put_all, newest), 0);
    while (record.number < RECORDS) {
        if (!newest_take(newest, &record))
            continue;
        ck_assert_uint_gt(record.number, before);
        before = record.number;
        ck_assert_uint_eq(record.twice, 2 * record.number);
        ck_assert_uint_eq(record.thrice, 3 * record.number);
    }
    pthread_join(writer, NULL);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_was_not_taken_is_replaced,
                                  between_two_threads_the_last_one_arrives_whole};

    return SUITE_RUN("newest", tests);
}
