/* Models on disk, on the real file system: what is saved comes back, what was learned is there at
 * the next start, what is damaged or another's is refused. */
#include "common/program/log.h"
#include "learner/store/model_file.h"
#include "learner/store/store.h"
#include "store_bench.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char directory[] = "/tmp/reach-model-XXXXXX";
static char path[256];
static char error[MODEL_REASON_MOST];

static void setup(void)
{
    log_open("test", LOG_LEVEL_ERROR - 1);
    ck_assert_ptr_nonnull(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/model-3.imle", directory);
}

static struct model_store_settings automatic(void)
{
    setup();
    return store_bench_settings(directory, NULL);
}

static struct store_bench manual(void)
{
    struct model_store_settings settings = automatic();

    settings.automatic = false;
    return store_bench_create(&settings);
}

static enum model_store_result finish(struct store_bench *bench)
{
    enum model_store_result result = MODEL_STORE_NOTHING;

    for (int i = 0; i < 3 && result == MODEL_STORE_NOTHING; i++) {
        store_bench_serve(bench);
        result = model_store_poll(bench->store, &bench->learner);
    }
    store_bench_serve(bench);
    /* As every tick does: only here the loop sees that the store is ready again. */
    ck_assert_int_eq(model_store_poll(bench->store, &bench->learner), MODEL_STORE_NOTHING);
    return result;
}

static enum model_store_result save(struct store_bench *bench)
{
    ck_assert(model_store_begin_save(bench->store, 3));
    ck_assert(!model_store_begin_save(bench->store, 3)); /* busy */
    return finish(bench);
}

static enum model_store_result load(struct store_bench *bench)
{
    ck_assert(model_store_begin_load(bench->store, 3));
    return finish(bench);
}

START_TEST(what_is_saved_comes_back)
{
    struct store_bench bench = manual();
    uint64_t hash;

    store_bench_learn(&bench, 50);
    hash = store_bench_hash(&bench);
    ck_assert(model_store_begin_save(bench.store, 3));
    store_bench_learn(&bench, 5); /* what comes after is not in it */
    ck_assert_int_eq(finish(&bench), MODEL_STORE_DONE);
    ck_assert_uint_ne(store_bench_hash(&bench), hash);
    ck_assert_int_eq(load(&bench), MODEL_STORE_DONE);
    ck_assert_uint_eq(store_bench_hash(&bench), hash);
    /* Both learners have changed places, and go on as one. */
    store_bench_learn(&bench, 20);
    hash = store_bench_hash(&bench);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE);
    ck_assert_int_eq(load(&bench), MODEL_STORE_DONE);
    ck_assert_uint_eq(store_bench_hash(&bench), hash);
    store_bench_close(&bench);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(rmdir(directory), 0); /* nothing else was written */
}
END_TEST

static void flip(long at)
{
    FILE *file = fopen(path, "r+b");
    int byte;

    fseek(file, at, SEEK_SET);
    byte = fgetc(file);
    fseek(file, at, SEEK_SET);
    fputc(byte ^ 0x10, file);
    fclose(file);
}

/* A flipped bit is never taken for a model, and the file stays as it is. */
START_TEST(a_damaged_file_is_refused)
{
    struct store_bench bench = manual();
    struct stat status;

    store_bench_learn(&bench, 50);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE);
    stat(path, &status);
    for (long at = 0; at < status.st_size; at += at < 200 ? 1 : 97) {
        flip(at);
        ck_assert_msg(load(&bench) == MODEL_STORE_FAILED, "byte %ld", at);
        flip(at);
    }
    ck_assert_int_eq(load(&bench), MODEL_STORE_DONE);
    ck_assert_int_eq(truncate(path, status.st_size - 1), 0);
    ck_assert_int_eq(load(&bench), MODEL_STORE_FAILED);
    unlink(path);
    ck_assert_int_eq(load(&bench), MODEL_STORE_FAILED);
    ck_assert_int_eq(mkfifo(path, 0600), 0); /* nobody ever writes into it */
    ck_assert_int_eq(load(&bench), MODEL_STORE_FAILED);
    unlink(path);
    ck_assert_int_eq(mkdir(path, 0700), 0);
    ck_assert_int_eq(load(&bench), MODEL_STORE_FAILED);
    rmdir(path);
    store_bench_close(&bench);
    rmdir(directory);
}
END_TEST

START_TEST(saving_over_a_damaged_file_keeps_it)
{
    struct store_bench bench = manual();
    char aside[300];

    snprintf(aside, sizeof aside, "%s.damaged-1", path);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE); /* a good one makes room */
    ck_assert_int_ne(access(aside, F_OK), 0);
    flip(40);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE);
    ck_assert_int_eq(access(aside, F_OK), 0);
    ck_assert_int_eq(load(&bench), MODEL_STORE_DONE);
    store_bench_close(&bench);
    unlink(aside);
    unlink(path);
    rmdir(directory);
}
END_TEST

/* The file is whole, but the learner of another configuration does not take it. */
START_TEST(a_model_of_other_parameters_is_refused)
{
    struct store_bench bench = manual();
    struct model_store_settings settings = store_bench_settings(directory, NULL);
    struct store_bench other;
    uint64_t hash;

    store_bench_learn(&bench, 50);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE);
    store_bench_close(&bench);
    settings.automatic = false;
    settings.learner.alpha = 0.95;
    other = store_bench_create(&settings);
    store_bench_learn(&other, 7);
    hash = store_bench_hash(&other);
    ck_assert_int_eq(load(&other), MODEL_STORE_FAILED);
    ck_assert_uint_eq(store_bench_hash(&other), hash);
    ck_assert(model_store_begin_load(other.store, 3)); /* free again */
    store_bench_close(&other);
    unlink(path);
    rmdir(directory);
}
END_TEST

START_TEST(what_was_learned_is_there_at_the_next_start)
{
    struct model_store_settings settings = automatic();
    struct store_bench bench = store_bench_create(&settings);
    uint64_t hash = 0;

    for (int start = 0; start < 5; start++) {
        ck_assert_uint_eq(model_samples(bench.learner), (uint64_t)(23 * start));
        for (int i = 0; i < 23; i++) {
            store_bench_learn(&bench, 1);
            store_bench_serve(&bench);
        }
        hash = store_bench_hash(&bench);
        store_bench_close(&bench);
        bench = store_bench_create(&settings);
        ck_assert_uint_eq(store_bench_hash(&bench), hash);
    }
    /* Whoever comes second gets a reason. */
    ck_assert_ptr_null(store_bench_try(&settings, error, sizeof error).store);
    ck_assert_ptr_nonnull(strstr(error, "another program"));
    ck_assert_int_eq(model_store_check(&settings, error, sizeof error), -1);
    store_bench_close(&bench);
    ck_assert_int_eq(model_store_check(&settings, error, sizeof error), 0);
    ck_assert_ptr_nonnull(strstr(error, "115 samples"));
    settings.learner.alpha = 0.95;
    ck_assert_ptr_null(store_bench_try(&settings, error, sizeof error).store);
    ck_assert_ptr_nonnull(strstr(error, "other parameters"));
    ck_assert_ptr_nonnull(strstr(error, directory));
    store_bench_remove(directory);
}
END_TEST

START_TEST(without_a_directory_nothing_is_stored)
{
    struct model_store_settings settings = store_bench_settings("", NULL);
    struct store_bench bench = store_bench_create(&settings);

    ck_assert(!model_store_begin_load(bench.store, 0));
    store_bench_learn(&bench, 3000); /* more than any mailbox holds */
    ck_assert_uint_eq(model_samples(bench.learner), 3000);
    ck_assert(!model_store_report(bench.store).storing);
    store_bench_close(&bench);
}
END_TEST

/* Housekeeping stands still, as behind a disk that hangs: learning waits, nothing is lost, and what
 * is stored afterwards has no hole. */
START_TEST(a_full_mailbox_makes_learning_wait)
{
    struct model_store_settings settings = automatic();
    struct store_bench bench = store_bench_create(&settings);
    int learned = 0;

    while (store_bench_learn_one(&bench))
        learned++;
    ck_assert_int_gt(learned, 100);
    ck_assert(model_store_full(bench.store));
    ck_assert(!store_bench_learn_one(&bench));
    ck_assert_int_eq(model_store_report(bench.store).waits, 2);
    store_bench_serve(&bench);
    ck_assert(!model_store_full(bench.store));
    store_bench_learn(&bench, 10);
    uint64_t hash = store_bench_hash(&bench);
    store_bench_close(&bench);
    bench = store_bench_create(&settings);
    ck_assert_uint_eq(store_bench_hash(&bench), hash);
    ck_assert_uint_eq(model_samples(bench.learner), (uint64_t)(learned + 10));
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

/* What was loaded is the model from then on, at the next start as well. */
START_TEST(a_load_replaces_the_model_that_is_kept)
{
    struct model_store_settings settings = automatic();
    struct store_bench bench = store_bench_create(&settings);
    uint64_t hash;

    store_bench_learn(&bench, 30);
    hash = store_bench_hash(&bench);
    ck_assert_int_eq(save(&bench), MODEL_STORE_DONE);
    store_bench_learn(&bench, 100);
    store_bench_serve(&bench);
    ck_assert(model_store_begin_load(bench.store, 3));
    store_bench_serve(&bench);
    store_bench_learn(&bench, 4); /* by the model that goes: not part of what comes */
    ck_assert_int_eq(model_store_poll(bench.store, &bench.learner), MODEL_STORE_DONE);
    ck_assert_uint_eq(store_bench_hash(&bench), hash);
    ck_assert_int_eq(model_store_report(bench.store).stored, 0); /* not yet on disk as such */
    store_bench_serve(&bench);
    ck_assert_int_eq(model_store_report(bench.store).stored, 30);
    store_bench_learn(&bench, 5);
    hash = store_bench_hash(&bench);
    store_bench_close(&bench);
    bench = store_bench_create(&settings);
    ck_assert_uint_eq(store_bench_hash(&bench), hash);
    ck_assert_uint_eq(model_samples(bench.learner), 35);
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_is_saved_comes_back,
                                  a_damaged_file_is_refused,
                                  saving_over_a_damaged_file_keeps_it,
                                  a_model_of_other_parameters_is_refused,
                                  what_was_learned_is_there_at_the_next_start,
                                  without_a_directory_nothing_is_stored,
                                  a_full_mailbox_makes_learning_wait,
                                  a_load_replaces_the_model_that_is_kept};

    /* What waits on a pipe must be noticed, and soon. */
    return suite_run("model_store", tests, sizeof tests / sizeof tests[0], 20);
}
