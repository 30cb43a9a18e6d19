/* Who has asked what: a request is done once, in whatever order requests come. */
#include "learner/service/clients.h"
#include "tests/unit/suite.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "common/base/random.h"

static struct arena *arena;
static struct clients *clients;

static void setup(void)
{
    arena = arena_create(clients_memory());
    clients = clients_create(arena);
    ck_assert_ptr_nonnull(clients);
}

/* As the desk does it: what is new is done. */
static enum clients_verdict ask(int64_t client, int64_t seq)
{
    struct deed *deed;
    enum clients_verdict verdict = clients_look(clients, client, seq, &deed);

    if (verdict == CLIENTS_NEW)
        *deed = (struct deed){.seq = seq, .sample = seq * 10};
    if (verdict == CLIENTS_REPEATED) {
        ck_assert_int_eq(deed->seq, seq);
        ck_assert_int_eq(deed->sample, seq * 10);
    }
    return verdict;
}

START_TEST(who_is_not_known_is_told)
{
    setup();
    ck_assert_int_eq(ask(7, 1), CLIENTS_UNKNOWN);
    clients_admit(clients, 7, 1);
    ck_assert_int_eq(ask(7, 1), CLIENTS_FORGOTTEN); /* what made it known, and what was before */
    ck_assert_int_eq(ask(7, 2), CLIENTS_NEW);
    ck_assert_int_eq(ask(7, 2), CLIENTS_REPEATED);
    ck_assert_int_eq(ask(8, 2), CLIENTS_UNKNOWN);
    clients_admit(clients, 7, 5); /* again: changes nothing */
    ck_assert_int_eq(ask(7, 2), CLIENTS_REPEATED);
    ck_assert_int_eq(ask(7, 3), CLIENTS_NEW);
}
END_TEST

START_TEST(one_that_overtook_is_no_reason_to_forget)
{
    setup();
    clients_admit(clients, 7, 1);
    ck_assert_int_eq(ask(7, 40), CLIENTS_NEW);
    ck_assert_int_eq(ask(7, 39), CLIENTS_NEW);
    ck_assert_int_eq(ask(7, 2), CLIENTS_NEW);
    ck_assert_int_eq(ask(7, 2 + CLIENTS_REMEMBERED), CLIENTS_NEW);
    ck_assert_int_eq(ask(7, 2), CLIENTS_FORGOTTEN); /* its place is taken */
    ck_assert_int_eq(ask(7, 39), CLIENTS_REPEATED);
}
END_TEST

START_TEST(who_is_silent_longest_makes_room)
{
    setup();
    for (int64_t client = 1; client <= CLIENTS_MOST; client++)
        clients_admit(clients, client, 1);
    ck_assert_int_eq(ask(1, 2), CLIENTS_NEW);
    clients_admit(clients, 1000, 1);
    ck_assert_int_eq(ask(1, 2), CLIENTS_REPEATED);
    ck_assert_int_eq(ask(2, 2), CLIENTS_UNKNOWN);
    ck_assert_int_eq(ask(3, 2), CLIENTS_NEW);
    clients_admit(clients, 2, 9); /* what it may have asked before is over */
    ck_assert_int_eq(ask(2, 9), CLIENTS_FORGOTTEN);
    ck_assert_int_eq(ask(2, 10), CLIENTS_NEW);
}
END_TEST

/* Repeated, lost and reordered at random: nothing is done twice. */
START_TEST(nothing_is_done_twice)
{
    enum { REQUESTS = 20000, SPREAD = 200 };
    static bool done[REQUESTS + SPREAD];
    const char *given = getenv("REACH_TEST_SEED");
    uint64_t seed = given ? strtoull(given, NULL, 10) : (uint64_t)time(NULL);
    struct random_state random;
    int times[4] = {0};

    setup();
    printf("REACH_TEST_SEED=%" PRIu64 "\n", seed);
    random = random_seed((int64_t)seed);
    clients_admit(clients, 7, 1);
    for (int i = 2; i < REQUESTS; i++) {
        int64_t seq = i + (int64_t)random_uniform(&random, 0, SPREAD);
        enum clients_verdict verdict = ask(7, seq);
        times[verdict]++;
        if (verdict == CLIENTS_NEW) {
            ck_assert(!done[seq]);
            done[seq] = true;
        }
        if (verdict == CLIENTS_REPEATED)
            ck_assert(done[seq]);
    }
    ck_assert_int_gt(times[CLIENTS_NEW], REQUESTS / 10);
    ck_assert_int_gt(times[CLIENTS_REPEATED], REQUESTS / 10);
    ck_assert_int_gt(times[CLIENTS_FORGOTTEN], REQUESTS / 10);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {who_is_not_known_is_told, one_that_overtook_is_no_reason_to_forget,
                            who_is_silent_longest_makes_room, nothing_is_done_twice};

    return SUITE_RUN("clients", tests);
}
