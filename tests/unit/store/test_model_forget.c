/* A body that is taken away again: both learners are then what one is without a store, so is what a
 * start finds after an end at any instant, and the search begins anew at once. */
#include "body_bench.h"
#include "common/program/log.h"
#include "learner/store/model_file.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_GIVEN = 100 };

static char directory[40];
static struct model_store_settings settings;

static struct store_bench begin(void)
{
    log_open("test", LOG_LEVEL_ERROR - 1);
    snprintf(directory, sizeof directory, "/tmp/reach-forget-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(directory));
    settings = body_bench_settings(directory);
    return store_bench_create(&settings);
}

static void end(struct store_bench *bench)
{
    store_bench_close(bench);
    store_bench_remove(directory);
}

static void serve(struct store_bench *bench)
{
    bench->now += 20000;
    model_store_serve(bench->store, bench->now);
}

/* Ticks until the learner has a body, or has none. Returns its samples when that changed. */
static uint64_t ticks_until(struct store_bench *bench, bool with_body)
{
    uint64_t samples = 0;

    for (int i = 0; (learner_body(bench->learner) != NULL) != with_body; i++) {
        ck_assert_int_lt(i, 40);
        samples = model_samples(bench->learner);
        body_bench_tick(bench);
        serve(bench);
    }
    return samples;
}

/* What the next start finds if the process ends at this instant. */
static uint64_t hash_after_a_kill(void)
{
    char copy[] = "/tmp/reach-forget-copy-XXXXXX";
    char command[200];
    struct model_store_settings there = settings;
    struct store_bench bench;

    ck_assert_ptr_nonnull(mkdtemp(copy));
    snprintf(command, sizeof command, "cp -r %s/. %s", directory, copy);
    ck_assert_int_eq(system(command), 0); /* NOLINT(cert-env33-c): names are ours */
    there.directory = copy;
    bench = store_bench_create(&there);
    uint64_t hash = store_bench_hash(&bench);
    store_bench_close(&bench);
    store_bench_remove(copy);
    return hash;
}

START_TEST(the_search_begins_anew)
{
    struct store_bench bench = begin();
    uint64_t given[MOST_GIVEN] = {ticks_until(&bench, true)};
    int n = 1;

    /* So many, and a search so lately, that several more would have to come before the next one. */
    for (int i = 0; i < 250 || given[n - 1] + 1 < model_samples(bench.learner); i++) {
        uint64_t again = body_bench_tick(&bench);
        ck_assert_int_lt(n, MOST_GIVEN - 1);
        if (again)
            given[n++] = again;
        serve(&bench);
    }
    int before = body_bench_finder.asked;
    model_store_begin_forgetting(bench.store);
    uint64_t taken = ticks_until(&bench, false);
    ck_assert_int_eq(body_bench_finder.asked, before + 1);
    ck_assert_int_eq(model_store_moment(bench.store).result, MODEL_STORE_DONE);
    ck_assert_int_eq(model_store_moment(bench.store).body, MODEL_STORE_BODY_TAKEN);
    ck_assert_uint_gt(taken, given[0]);
    given[n++] = ticks_until(&bench, true);
    ck_assert(!body_bench_finder.started);
    ck_assert_int_ge(body_bench_finder.samples, 15);
    ck_assert_uint_gt(given[n - 1], taken);
    ck_assert_uint_eq(
        store_bench_hash(&bench),
        body_bench_hash_forgetting(&settings, model_samples(bench.learner), given, n, taken));
    serve(&bench);
    ck_assert_uint_eq(hash_after_a_kill(), store_bench_hash(&bench));
    end(&bench);
}
END_TEST

/* Stored before the loop goes on without the body, and not before it was asked. */
START_TEST(it_is_forgotten_on_disk_too)
{
    struct store_bench bench = begin();
    uint64_t given = ticks_until(&bench, true);

    serve(&bench);
    uint64_t with = hash_after_a_kill();
    ck_assert_uint_eq(with, body_bench_hash_at(&settings, model_samples(bench.learner), &given, 1));
    model_store_begin_forgetting(bench.store);
    body_bench_finder.absent = true;
    uint64_t taken = ticks_until(&bench, false);
    ck_assert_uint_eq(
        hash_after_a_kill(),
        body_bench_hash_forgetting(&settings, model_samples(bench.learner), &given, 1, taken));
    body_bench_finder.absent = false;
    end(&bench);
}
END_TEST

/* What a search under way would still find belongs to what is forgotten. */
START_TEST(a_search_under_way_is_given_up)
{
    struct store_bench bench = begin();
    int before;

    ticks_until(&bench, true);
    before = body_bench_finder.asked;
    body_bench_finder.absent = true; /* asked, and silent */
    while (body_bench_finder.asked == before) {
        body_bench_tick(&bench);
        serve(&bench);
    }
    ck_assert_int_eq(model_store_report(bench.store).search, MODEL_STORE_SEARCHING);
    int64_t old = body_bench_finder.seq;
    model_store_begin_forgetting(bench.store);
    ticks_until(&bench, false);
    ck_assert_int_gt((int)body_bench_finder.seq, (int)old);
    body_bench_finder.seq = old; /* the late answer */
    body_bench_finder.absent = false;
    for (int i = 0; i < 3; i++) {
        body_bench_tick(&bench);
        serve(&bench);
    }
    ck_assert_ptr_null(learner_body(bench.learner));
    end(&bench);
}
END_TEST

static void tick(struct store_bench *bench)
{
    body_bench_tick(bench);
    serve(bench);
}

/* The finder says that the body in use is none: it goes, and the search begins anew. */
START_TEST(a_body_that_is_refuted_goes)
{
    struct store_bench bench = begin();
    uint64_t given = ticks_until(&bench, true);
    int before = body_bench_finder.asked;

    body_bench_finder.outcome = FINDER_REFUTED;
    uint64_t taken = ticks_until(&bench, false);
    body_bench_finder.outcome = FINDER_FOUND;
    ck_assert_int_eq(model_store_moment(bench.store).body, MODEL_STORE_BODY_TAKEN);
    ck_assert_int_eq(model_store_moment(bench.store).result, MODEL_STORE_NOTHING);
    ck_assert_int_eq(body_bench_finder.asked, before + 2); /* at once */
    ck_assert_uint_eq(
        store_bench_hash(&bench),
        body_bench_hash_forgetting(&settings, model_samples(bench.learner), &given, 1, taken));
    serve(&bench);
    ck_assert_uint_eq(hash_after_a_kill(), store_bench_hash(&bench));
    ticks_until(&bench, true);
    ck_assert_int_eq(model_store_report(bench.store).search, MODEL_STORE_FOUND);
    end(&bench);
}
END_TEST

/* While a change of the body is followed, a search of before it may still be under way: what it
 * finds is the body of before. */
START_TEST(what_was_found_before_a_change_is_not_taken)
{
    struct store_bench bench = begin();

    ticks_until(&bench, true);
    for (int i = 0; i < 900; i++)
        tick(&bench);
    body_bench_finder.slow = true;
    for (int asked = body_bench_finder.asked; body_bench_finder.asked == asked; tick(&bench))
        ck_assert_uint_lt(model_samples(bench.learner), 3000);
    body_bench_moves_at = model_samples(bench.learner) + 1;
    while (learner_get_body_change(bench.learner).changes == 0) {
        ck_assert_uint_lt(model_samples(bench.learner), body_bench_moves_at + 100);
        tick(&bench);
    }
    int asked = body_bench_finder.asked;
    body_bench_finder.slow = false;
    for (int i = 0; body_bench_finder.asked == asked; i++) {
        ck_assert_int_lt(i, 10); /* another search is due at once */
        tick(&bench);
        ck_assert_int_eq(model_store_moment(bench.store).body, 0);
    }
    ck_assert_double_gt(learner_body(bench.learner)->chain.offset[0][1], 0.019);
    end(&bench);
}
END_TEST

START_TEST(without_a_directory_it_is_the_same)
{
    struct store_bench bench = begin();

    end(&bench);
    settings.directory = "";
    bench = store_bench_create(&settings);
    uint64_t given = ticks_until(&bench, true);
    body_bench_finder.absent = true;
    model_store_begin_forgetting(bench.store);
    uint64_t taken = ticks_until(&bench, false);
    ck_assert_uint_eq(
        store_bench_hash(&bench),
        body_bench_hash_forgetting(&settings, model_samples(bench.learner), &given, 1, taken));
    store_bench_close(&bench);
}
END_TEST

START_TEST(the_body_in_use_is_told_when_asked)
{
    struct store_bench bench = begin();

    model_store_tell_body(bench.store);
    serve(&bench);
    ck_assert_int_eq(body_bench_finder.told, 0); /* there is none */
    ticks_until(&bench, true);
    serve(&bench);
    serve(&bench);
    ck_assert_int_eq(body_bench_finder.told, 0);
    model_store_tell_body(bench.store);
    serve(&bench);
    serve(&bench);
    ck_assert_int_eq(body_bench_finder.told, 1);
    end(&bench);
}
END_TEST

/* The robot's URDF, say; so does the first one after a body that was refuted. */
START_TEST(the_first_search_begins_with_a_given_body)
{
    struct body start = body_bench_body();
    struct store_bench bench = begin();

    store_bench_close(&bench);
    settings.start = &start;
    bench = store_bench_create(&settings);
    ticks_until(&bench, true);
    ck_assert_int_eq(body_bench_finder.asked, 1);
    ck_assert(body_bench_finder.started);
    body_bench_finder.outcome = FINDER_REFUTED;
    ticks_until(&bench, false);
    ck_assert(body_bench_finder.started);
    end(&bench);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        the_search_begins_anew,
        it_is_forgotten_on_disk_too,
        a_search_under_way_is_given_up,
        a_body_that_is_refuted_goes,
        what_was_found_before_a_change_is_not_taken,
        without_a_directory_it_is_the_same,
        the_body_in_use_is_told_when_asked,
        the_first_search_begins_with_a_given_body,
    };

    return SUITE_RUN("model_forget", tests);
}
