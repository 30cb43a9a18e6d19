/* The mailbox between two threads: nothing lost, nothing torn, nothing twice. */
#include "common/base/mailbox.h"
#include "tests/unit/suite.h"

#include <pthread.h>
#include <sched.h>

#define RECORDS 300000

struct record {
    uint64_t number, twice, thrice;
};

START_TEST(a_full_box_refuses_and_counts)
{
    struct arena *arena = arena_create(mailbox_memory(sizeof(int), 4));
    struct mailbox *box = mailbox_create(arena, sizeof(int), 4);
    int value;

    ck_assert_ptr_nonnull(box);
    for (int i = 0; i < 4; i++)
        ck_assert(mailbox_put(box, &i));
    ck_assert(!mailbox_put(box, &(int){9}));
    ck_assert_uint_eq(mailbox_refused(box), 1);
    for (int i = 0; i < 4; i++) {
        ck_assert(mailbox_take(box, &value));
        ck_assert_int_eq(value, i);
    }
    ck_assert(!mailbox_take(box, &value));
    arena_destroy(arena);
}
END_TEST

static void *put_all(void *user)
{
    for (uint64_t i = 1; i <= RECORDS; i++) {
        struct record record = {i, 2 * i, 3 * i};
        while (!mailbox_put(user, &record))
            sched_yield();
    }
    return NULL;
}

START_TEST(two_threads_lose_nothing)
{
    struct arena *arena = arena_create(mailbox_memory(sizeof(struct record), 64));
    struct mailbox *box = mailbox_create(arena, sizeof(struct record), 64);
    struct record record;
    pthread_t writer;

    ck_assert_int_eq(pthread_create(&writer, NULL, put_all, box), 0);
    for (uint64_t i = 1; i <= RECORDS; i++) {
        while (!mailbox_take(box, &record))
            sched_yield();
        ck_assert_uint_eq(record.number, i);
        ck_assert_uint_eq(record.twice, 2 * i);
        ck_assert_uint_eq(record.thrice, 3 * i);
    }
    pthread_join(writer, NULL);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_full_box_refuses_and_counts, two_threads_lose_nothing};

    return SUITE_RUN("mailbox", tests);
}
