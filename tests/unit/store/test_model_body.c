/* A body is found while learning goes on, and never lost: searches are due when samples say so, the
 * learner that was given one is to the byte what it is without a store, and so is what a start
 * finds after an end at any instant. */
#include "body_bench.h"
#include "common/program/log.h"
#include "learner/store/model_file.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static char directory[40];
static struct model_store_settings settings;

static void begin(void)
{
    log_open("test", LOG_LEVEL_ERROR - 1);
    snprintf(directory, sizeof directory, "/tmp/reach-body-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(directory));
    settings = body_bench_settings(directory);
    settings.snapshot_samples = 1000;
}

/* Ticks, each with housekeeping behind it. Returns the samples at the newest body, 0 = none. */
static uint64_t ticks(struct store_bench *bench, int n)
{
    uint64_t newest = 0;

    for (int i = 0; i < n; i++) {
        uint64_t given = body_bench_tick(bench);
        newest = given ? given : newest;
        bench->now += 20000;
        model_store_serve(bench->store, bench->now);
    }
    return newest;
}

START_TEST(a_search_is_due_after_fifteen_samples_that_differ)
{
    struct store_bench bench;
    uint64_t given;

    begin();
    bench = store_bench_create(&settings);
    ticks(&bench, 14);
    ck_assert_int_eq(body_bench_finder.asked, 0);
    given = ticks(&bench, 4);
    ck_assert_int_eq(body_bench_finder.asked, 1);
    ck_assert_int_eq(body_bench_finder.samples, 15);
    ck_assert(!body_bench_finder.started);
    ck_assert_uint_ge(given, 15);
    ck_assert_ptr_nonnull(learner_body(bench.learner));
    ck_assert_int_eq(model_store_report(bench.store).search, MODEL_STORE_FOUND);
    ck_assert_int_eq(model_store_report(bench.store).searches, 1);
    ticks(&bench, 80);
    ck_assert_int_gt(body_bench_finder.asked, 1);
    ck_assert(body_bench_finder.started);
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

START_TEST(both_learners_are_what_one_is_without_a_store)
{
    struct store_bench bench;
    uint64_t given[100];
    int n = 0;

    begin();
    bench = store_bench_create(&settings);
    while (model_samples(bench.learner) < 60) {
        uint64_t now = ticks(&bench, 1);
        ck_assert_int_lt(n, 100);
        if (now)
            given[n++] = now;
    }
    ck_assert_int_gt(n, 1);
    ck_assert_uint_eq(store_bench_hash(&bench), body_bench_hash_at(&settings, 60, given, n));
    store_bench_close(&bench); /* which writes what the shadow is */
    bench = store_bench_create(&settings);
    ck_assert_uint_eq(store_bench_hash(&bench), body_bench_hash_at(&settings, 60, given, n));
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

/* The files of a directory in another, as they are: what a kill at this instant leaves. */
static void copy_directory(const char *to)
{
    char command[200];

    snprintf(command, sizeof command, "cp -r %s/. %s", directory, to);
    ck_assert_int_eq(system(command), 0); /* NOLINT(cert-env33-c): names are ours */
}

/* A start on that. Returns the hash of what it finds, of so many samples. */
static uint64_t recover(const char *from, uint64_t samples)
{
    struct model_store_settings there = settings;
    struct store_bench bench;
    uint64_t hash;

    there.directory = from;
    bench = store_bench_create(&there);
    ck_assert_uint_eq(model_samples(bench.learner), samples);
    hash = store_bench_hash(&bench);
    store_bench_close(&bench);
    store_bench_remove(from);
    return hash;
}

/* The body is on disk at one instant, before the loop steers by it, and from then on. */
START_TEST(killed_at_every_tick)
{
    struct store_bench bench;
    uint64_t steers_at = 0;
    bool stored = false;

    begin();
    bench = store_bench_create(&settings);
    for (int i = 0; i < 18; i++) {
        char copy[] = "/tmp/reach-body-copy-XXXXXX";
        steers_at += ticks(&bench, 1);
        ck_assert_ptr_nonnull(mkdtemp(copy));
        copy_directory(copy);
        uint64_t samples = model_samples(bench.learner);
        uint64_t at = steers_at ? steers_at : samples;
        uint64_t hash = recover(copy, samples);
        stored = stored || hash != body_bench_hash_at(&settings, samples, NULL, 0);
        ck_assert(stored || !steers_at);
        ck_assert_uint_eq(hash, body_bench_hash_at(&settings, samples, &at, stored));
    }
    ck_assert_uint_ne(steers_at, 0);
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

static void journal_path(const char *in, char *path, size_t size)
{
    snprintf(path, size, "%s/current-000000.journal", in);
    if (access(path, F_OK) != 0)
        snprintf(path, size, "%s/current-000001.journal", in);
    ck_assert_int_eq(access(path, F_OK), 0);
}

static long size_of(const char *path)
{
    FILE *file = fopen(path, "rb");
    long size;

    fseek(file, 0, SEEK_END);
    size = ftell(file);
    fclose(file);
    return size;
}

/* Cut anywhere within the body or behind it: with the body when all of it is there. */
START_TEST(a_torn_body_is_cut_off)
{
    struct store_bench bench;
    char path[120];

    begin();
    settings.sync_us = INT64_MAX; /* no marks but the body's and the first's */
    bench = store_bench_create(&settings);
    store_bench_serve(&bench);
    uint64_t given = ticks(&bench, 19);
    ck_assert_uint_ne(given, 0);
    uint64_t samples = model_samples(bench.learner);
    journal_path(directory, path, sizeof path);
    long whole = size_of(path);
    long body_ends = 32 + 208 * ((long)given + 244);
    ck_assert_int_eq(whole, body_ends + 208 * (1 + (long)(samples - given)));
    const long cuts[] = {whole, body_ends + 208, body_ends, body_ends - 1,
                         body_ends - 208 * 244 + 5};
    for (size_t i = 0; i < sizeof cuts / sizeof cuts[0]; i++) {
        char copy[] = "/tmp/reach-body-copy-XXXXXX";
        ck_assert_ptr_nonnull(mkdtemp(copy));
        copy_directory(copy);
        journal_path(copy, path, sizeof path);
        ck_assert_int_eq(truncate(path, cuts[i]), 0);
        strcat(path, ".head"); /* as the power's loss cuts: this one was not synced either */
        ck_assert_int_eq(unlink(path), 0);
        uint64_t left = i == 0 ? samples : given;
        ck_assert_uint_eq(recover(copy, left),
                          body_bench_hash_at(&settings, left, &given, cuts[i] >= body_ends));
    }
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

static void flip(const char *path, long at)
{
    FILE *file = fopen(path, "r+b");
    int byte;

    ck_assert_ptr_nonnull(file);
    fseek(file, at, SEEK_SET);
    byte = getc(file);
    fseek(file, at, SEEK_SET);
    putc(byte ^ 1, file);
    fclose(file);
}

/* What was safe once is never passed over in silence, also where no sample followed it. */
START_TEST(a_damaged_body_is_refused)
{
    struct store_bench bench;
    char path[100];
    char error[MODEL_REASON_MOST];

    begin();
    settings.keep = 1;
    bench = store_bench_create(&settings);
    while (!body_bench_finder.answered)
        ticks(&bench, 1);
    ticks(&bench, 1);
    char copy[] = "/tmp/reach-body-copy-XXXXXX";
    ck_assert_ptr_nonnull(mkdtemp(copy));
    copy_directory(copy);
    store_bench_close(&bench);
    store_bench_remove(directory);
    journal_path(copy, path, sizeof path);
    settings.directory = copy;
    flip(path, size_of(path) - 208 * 100);
    bench = store_bench_try(&settings, error, sizeof error);
    ck_assert_ptr_null(bench.store);
    ck_assert_ptr_nonnull(strstr(error, "damaged: samples that were stored"));
    store_bench_remove(copy);
}
END_TEST

START_TEST(without_a_finder_learning_goes_on)
{
    struct store_bench bench;

    begin();
    bench = store_bench_create(&settings);
    body_bench_finder.absent = true;
    ticks(&bench, 15);
    ck_assert(model_store_works(bench.store));
    ck_assert_int_eq(model_store_report(bench.store).search, MODEL_STORE_SEARCHING);
    ticks(&bench, 185); /* almost four seconds */
    ck_assert_int_eq(model_store_report(bench.store).search, MODEL_STORE_NO_FINDER);
    ck_assert_int_gt(body_bench_finder.again, 2);
    ck_assert(!model_store_works(bench.store));
    ck_assert_uint_eq(model_samples(bench.learner), 200);
    ck_assert_ptr_null(learner_body(bench.learner));
    body_bench_finder.absent = false;
    ck_assert_uint_ne(ticks(&bench, 200), 0);
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

START_TEST(an_arm_that_is_no_chain_is_said_so)
{
    struct store_bench bench;

    begin();
    bench = store_bench_create(&settings);
    body_bench_finder.outcome = FINDER_NO_CHAIN;
    ck_assert_uint_eq(ticks(&bench, 40), 0);
    ck_assert_int_eq(model_store_report(bench.store).search, MODEL_STORE_NO_CHAIN);
    ck_assert_uint_eq(model_samples(bench.learner), 40);
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

/* Nothing is stored, yet there is a shadow that is given bodies. */
START_TEST(without_a_directory)
{
    struct store_bench bench;

    begin();
    store_bench_remove(directory);
    settings.directory = "";
    bench = store_bench_create(&settings);
    uint64_t given = ticks(&bench, 18);
    ck_assert_uint_ne(given, 0);
    ck_assert_uint_eq(store_bench_hash(&bench),
                      body_bench_hash_at(&settings, model_samples(bench.learner), &given, 1));
    ck_assert(!model_store_begin_save(bench.store, 1));
    store_bench_close(&bench);
}
END_TEST

/* Under the thread sanitizer this finds what they share. */
START_TEST(two_threads)
{
    const struct timespec moment = {.tv_nsec = 200000};
    struct store_bench bench;
    uint64_t given[100];
    int n = 0;

    begin();
    bench = store_bench_create(&settings);
    store_bench_keep_house(&bench);
    while (model_samples(bench.learner) < 400) {
        uint64_t now = body_bench_tick(&bench);
        ck_assert_int_lt(n, 100);
        if (now)
            given[n++] = now;
        nanosleep(&moment, NULL);
    }
    store_bench_end_house();
    uint64_t samples = model_samples(bench.learner);
    ck_assert_int_gt(n, 1);
    ck_assert_uint_eq(store_bench_hash(&bench), body_bench_hash_at(&settings, samples, given, n));
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_search_is_due_after_fifteen_samples_that_differ,
        both_learners_are_what_one_is_without_a_store,
        killed_at_every_tick,
        a_torn_body_is_cut_off,
        a_damaged_body_is_refused,
        without_a_finder_learning_goes_on,
        an_arm_that_is_no_chain_is_said_so,
        without_a_directory,
        two_threads,
    };

    return SUITE_RUN("model_body", tests);
}
