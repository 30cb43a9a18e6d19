/* What keeping a model costs the disk over months, and what may make room there. */
#include "store_lives.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <string.h>

static size_t size_of(const char *name)
{
    size_t size = 0;

    return fake_disk_bytes(name, &size) ? size : 0;
}

static int count(const char *part)
{
    const char *name;
    int found = 0;

    for (int i = 0; (name = fake_disk_name(i)); i++)
        found += strstr(name, part) != NULL;
    return found;
}

/* The number in the newest snapshot's name: how many were made. */
static int snapshots(void)
{
    const char *name;
    int newest = 0;

    for (int i = 0; (name = fake_disk_name(i)); i++) {
        int number;
        if (sscanf(name, FAKE_DISK_DIRECTORY "/current-%d.imle", &number) == 1 && number > newest)
            newest = number;
    }
    return newest;
}

/* Two samples a second, and housekeeping as often as it may make a snapshot. */
static int snapshots_of_twenty_seconds(double rate)
{
    struct store_bench bench;
    int before;

    lives.settings.keep = 1;
    lives.settings.snapshot_samples = 2;
    lives.settings.snapshot_rate = rate;
    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    store_bench_serve(&bench);
    before = snapshots();
    for (int second = 0; second < 20; second++) {
        store_bench_learn(&bench, 2);
        store_bench_serve(&bench);
        ck_assert_int_eq(model_store_report(bench.store).stored, 2 * (second + 1));
    }
    before = snapshots() - before;
    lives_crash(&bench, FAKE_DISK_KILLED);
    bench = store_bench_create(&lives.settings); /* whatever the journal's length */
    ck_assert_uint_eq(model_samples(bench.learner), 40);
    store_bench_close(&bench);
    return before;
}

START_TEST(snapshots_keep_to_their_budget)
{
    char newest[80];
    size_t bytes;

    lives_setup("model_wear");
    ck_assert_int_eq(snapshots_of_twenty_seconds(0), 20); /* as the samples alone have it */
    snprintf(newest, sizeof newest, FAKE_DISK_DIRECTORY "/current-%06d.imle", snapshots());
    bytes = size_of(newest);
    ck_assert_uint_gt(bytes, 1000);
    int some = snapshots_of_twenty_seconds((double)bytes / 5);
    ck_assert_int_ge(some, 4); /* smaller ones at first */
    ck_assert_int_le(some, 8);
    ck_assert_int_eq(snapshots_of_twenty_seconds(1), 0);
}
END_TEST

/* Nobody waits long for a model after an orderly end. */
START_TEST(an_orderly_end_leaves_a_short_journal)
{
    struct store_bench bench;

    lives_setup("model_wear");
    lives.settings.keep = 1;
    lives.settings.snapshot_rate = 1e-9;
    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    store_bench_serve(&bench);
    store_bench_learn(&bench, 60);
    store_bench_close(&bench);
    ck_assert_uint_eq(size_of(FAKE_DISK_DIRECTORY "/current-000001.journal"), 32);
}
END_TEST

START_TEST(the_first_status_knows_what_is_stored)
{
    struct store_bench bench;
    int64_t stored;

    lives_setup("model_wear");
    fake_disk_reset(lives.seed);
    stored = lives_two();
    bench = store_bench_create(&lives.settings);
    ck_assert_int_eq(model_store_report(bench.store).stored, stored);
    ck_assert_int_gt(stored, 30);
    store_bench_close(&bench);
}
END_TEST

static void save_as(struct store_bench *bench, int number)
{
    ck_assert(model_store_begin_save(bench->store, number));
    store_bench_serve(bench);
    ck_assert_int_eq(model_store_poll(bench->store, &bench->learner), MODEL_STORE_DONE);
    model_store_poll(bench->store, &bench->learner);
}

START_TEST(of_the_saved_the_oldest_goes_first)
{
    const int order[] = {7, 3, 12, 3, 5, 1};
    struct store_bench bench;

    lives_setup("model_wear");
    lives.settings.saved_most = 3;
    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    for (int i = 0; i < 6; i++) {
        store_bench_learn(&bench, 2);
        save_as(&bench, order[i]);
    }
    ck_assert_int_eq(count("/model-"), 3);
    ck_assert_uint_gt(size_of(FAKE_DISK_DIRECTORY "/model-3.imle"), 0); /* written again */
    ck_assert_uint_gt(size_of(FAKE_DISK_DIRECTORY "/model-5.imle"), 0);
    ck_assert_uint_gt(size_of(FAKE_DISK_DIRECTORY "/model-1.imle"), 0);
    store_bench_close(&bench);
}
END_TEST

START_TEST(another_robots_model_is_set_aside)
{
    struct store_bench bench;

    lives_setup("model_wear");
    lives.settings.automatic = false;
    fake_disk_reset(lives.seed);
    bench = store_bench_create(&lives.settings);
    store_bench_learn(&bench, 20);
    save_as(&bench, 4);
    save_as(&bench, 4);
    ck_assert_int_eq(count(".damaged-"), 0); /* one's own makes room */
    store_bench_close(&bench);
    lives.settings.learner.alpha = 0.95;
    bench = store_bench_create(&lives.settings);
    store_bench_learn(&bench, 1);
    save_as(&bench, 4);
    ck_assert_uint_gt(size_of(FAKE_DISK_DIRECTORY "/model-4.imle.damaged-1"), 0);
    ck_assert_uint_gt(size_of(FAKE_DISK_DIRECTORY "/model-4.imle"), 0);
    store_bench_close(&bench);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        snapshots_keep_to_their_budget,        an_orderly_end_leaves_a_short_journal,
        the_first_status_knows_what_is_stored, of_the_saved_the_oldest_goes_first,
        another_robots_model_is_set_aside,
    };

    return SUITE_RUN("model_wear", tests);
}
