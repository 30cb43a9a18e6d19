/* Who keeps a replay's model says what the trace says, and has the models of the files. */
#include "daemon/replay/recorded_store.h"

#include "common/program/log.h"
#include "tests/unit/store/store_bench.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char directory[] = "/tmp/reach-recorded-XXXXXX";
static char path[sizeof directory + 20];
static const char *const paths[] = {path};
static struct model_store_settings settings;
static uint64_t hash; /* of the model in the file */
static struct recorded_store store;
static struct model_port port;
static struct arena *arena;
static struct learner *learner; /* the control step's */
static char error[MODEL_REASON_MOST];

/* A file with a model of 30 samples, and a learner that knows nothing. */
static void begin(void)
{
    struct store_bench bench;

    log_open("test", LOG_LEVEL_ERROR - 1);
    ck_assert_ptr_nonnull(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/model-1.imle", directory);
    settings = store_bench_settings(directory, NULL);
    settings.automatic = false;
    bench = store_bench_create(&settings);
    store_bench_learn(&bench, 30);
    ck_assert(model_store_begin_save(bench.store, 1));
    store_bench_serve(&bench);
    ck_assert_int_eq(model_store_poll(bench.store, &bench.learner), MODEL_STORE_DONE);
    hash = store_bench_hash(&bench);
    store_bench_close(&bench);

    store = (struct recorded_store){.paths = paths, .n_paths = 1};
    port = recorded_store_port(&store);
    arena = arena_create(learner_memory(&settings.learner));
    learner = learner_create(&settings.learner, arena, error, sizeof error);
    ck_assert_msg(learner != NULL, "%s", error);
}

static void end(void)
{
    recorded_store_close(&store);
    arena_destroy(arena);
    store_bench_remove(directory);
}

static int follow(enum model_result result, bool ready, uint64_t model)
{
    const struct model_moment moment = {.result = result, .ready = ready, .model = model};

    return recorded_store_follow(&store, &settings.learner, &moment, error, sizeof error);
}

START_TEST(a_run_begins_with_the_model_that_it_had)
{
    begin();
    ck_assert_int_eq(
        recorded_store_open(&store, &settings.learner, hash, learner, error, sizeof error), 0);
    ck_assert_uint_eq(model_samples(learner), 30);
    ck_assert_int_eq(follow(MODEL_NOTHING, true, hash), 0);
    port.ops->poll(port.context, &learner);
    ck_assert_uint_eq(model_samples(learner), 30);
    end();
}
END_TEST

START_TEST(a_model_that_was_loaded_takes_the_learners_place)
{
    struct learner *first;

    begin();
    first = learner;
    ck_assert_int_eq(follow(MODEL_NOTHING, true, 0), 0);
    ck_assert_int_eq(port.ops->poll(port.context, &learner), MODEL_NOTHING);
    ck_assert_ptr_eq(learner, first);
    ck_assert_int_eq(follow(MODEL_DONE, true, hash), 0);
    ck_assert_int_eq(port.ops->poll(port.context, &learner), MODEL_DONE);
    ck_assert_uint_eq(model_samples(learner), 30);
    ck_assert_uint_eq(port.ops->moment(port.context).model, hash);
    /* Once. */
    ck_assert_int_eq(follow(MODEL_NOTHING, true, hash), 0);
    ck_assert_int_eq(port.ops->poll(port.context, &learner), MODEL_NOTHING);
    ck_assert_ptr_ne(learner, first);
    end();
}
END_TEST

START_TEST(a_model_that_no_file_has_is_an_error)
{
    begin();
    ck_assert_int_eq(follow(MODEL_DONE, true, hash + 1), -1);
    ck_assert_ptr_nonnull(strstr(error, "no --model file has that"));
    end();
}
END_TEST

START_TEST(saves_and_loads_begin_when_they_did)
{
    begin();
    ck_assert(!port.ops->begin_save(port.context, 1)); /* nothing was said yet */
    for (int ready = 0; ready < 2; ready++) {
        ck_assert_int_eq(follow(MODEL_NOTHING, ready, 0), 0);
        port.ops->poll(port.context, &learner);
        ck_assert_int_eq(port.ops->begin_load(port.context, 1), ready);
        ck_assert(!port.ops->begin_save(port.context, 1)); /* one in a tick */
    }
    end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_run_begins_with_the_model_that_it_had, a_model_that_was_loaded_takes_the_learners_place,
        a_model_that_no_file_has_is_an_error, saves_and_loads_begin_when_they_did};

    return SUITE_RUN("recorded_store", tests);
}
