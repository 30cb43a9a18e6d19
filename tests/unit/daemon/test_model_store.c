/* Models on disk: what is saved comes back, what is damaged is refused. */
#include "common/log.h"
#include "fixture.h"
#include "model_store.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char directory[] = "/tmp/reach-model-XXXXXX";
static char path[256];
static struct learner_config config;

struct bench {
    struct arena *arena;
    struct learner *learner;
    struct model_store *store;
};

static struct bench bench_create(void)
{
    struct bench bench;
    char error[128];

    config = learner_config_default(2, 1);
    config.psi0[0] = 0.01;
    config.sigma0[0] = config.sigma0[1] = 1;
    config.capacity = 8;
    bench.arena =
        arena_create(learner_memory(&config) + model_store_memory(learner_memory(&config)));
    bench.learner = learner_create(&config, bench.arena, error, sizeof error);
    ck_assert_msg(bench.learner != NULL, "%s", error);
    bench.store = model_store_create(directory, learner_memory(&config), bench.arena);
    ck_assert_ptr_nonnull(bench.store);
    return bench;
}

static void learn_something(struct bench *bench)
{
    for (int i = 0; i < 50; i++)
        learner_update(bench->learner, (double[]){0.1 * (i % 7), 0.2 * (i % 5)},
                       (double[]){0.3 * (i % 7) - 0.1 * (i % 5)});
}

static double predicted(struct bench *bench)
{
    struct learner_prediction prediction;

    ck_assert_int_ge(learner_predict(bench->learner, (double[]){0.25, 0.45}, &prediction), 1);
    return prediction.solution[0].value[0];
}

static void save(struct bench *bench)
{
    ck_assert_ptr_nonnull(mkdtemp(directory));
    snprintf(path, sizeof path, "%s/model-3.imle", directory);
    ck_assert(model_store_begin_save(bench->store, bench->learner, 3));
    ck_assert(!model_store_begin_save(bench->store, bench->learner, 3)); /* busy */
    ck_assert_int_eq(model_store_poll(bench->store, bench->learner), MODEL_STORE_NOTHING);
    model_store_serve(bench->store);
    ck_assert_int_eq(model_store_poll(bench->store, bench->learner), MODEL_STORE_DONE);
}

static enum model_store_result load(struct bench *bench)
{
    ck_assert(model_store_begin_load(bench->store, 3));
    model_store_serve(bench->store);
    return model_store_poll(bench->store, bench->learner);
}

static void clean(struct bench *bench)
{
    unlink(path);
    rmdir(directory);
    arena_destroy(bench->arena);
}

START_TEST(what_is_saved_comes_back)
{
    struct bench bench = bench_create();
    struct bench other = bench_create();

    learn_something(&bench);
    save(&bench);
    ck_assert_int_eq(load(&other), MODEL_STORE_DONE);
    ck_assert_double_eq(predicted(&other), predicted(&bench));
    arena_destroy(other.arena);
    clean(&bench);
}
END_TEST

/* Every byte of the file in turn: a flipped bit is never taken for a model. */
START_TEST(a_damaged_file_is_refused)
{
    struct bench bench = bench_create();
    struct bench other = bench_create();
    struct stat status;
    FILE *file;

    log_open("test", LOG_LEVEL_ERROR - 1);
    learn_something(&bench);
    save(&bench);
    stat(path, &status);
    for (long at = 0; at < status.st_size; at += at < 200 ? 1 : 97) {
        int byte;
        file = fopen(path, "r+b");
        fseek(file, at, SEEK_SET);
        byte = fgetc(file);
        fseek(file, at, SEEK_SET);
        fputc(byte ^ 0x10, file);
        fclose(file);
        ck_assert_msg(load(&other) == MODEL_STORE_FAILED, "byte %ld", at);
        file = fopen(path, "r+b");
        fseek(file, at, SEEK_SET);
        fputc(byte, file);
        fclose(file);
    }
    ck_assert_int_eq(truncate(path, status.st_size - 1), 0);
    ck_assert_int_eq(load(&other), MODEL_STORE_FAILED);
    unlink(path);
    ck_assert_int_eq(load(&other), MODEL_STORE_FAILED);
    arena_destroy(other.arena);
    clean(&bench);
}
END_TEST

/* The file is whole, but the learner of another configuration does not take it. */
START_TEST(a_model_of_other_parameters_is_refused)
{
    struct bench bench = bench_create();
    struct bench other = bench_create();
    char error[128];

    log_open("test", LOG_LEVEL_ERROR - 1);
    learn_something(&bench);
    save(&bench);
    arena_destroy(other.arena);
    config.alpha = 0.95;
    other.arena =
        arena_create(learner_memory(&config) + model_store_memory(learner_memory(&config)));
    other.learner = learner_create(&config, other.arena, error, sizeof error);
    other.store = model_store_create(directory, learner_memory(&config), other.arena);
    ck_assert_int_eq(load(&other), MODEL_STORE_NOTHING); /* the reason is still to be logged */
    model_store_serve(other.store);
    ck_assert_int_eq(model_store_poll(other.store, other.learner), MODEL_STORE_FAILED);
    ck_assert(model_store_begin_load(other.store, 3)); /* free again */
    arena_destroy(other.arena);
    clean(&bench);
}
END_TEST

START_TEST(without_a_directory_saving_is_refused)
{
    struct bench bench = bench_create();
    struct model_store *store;

    arena_destroy(bench.arena);
    bench.arena = arena_create(1000000);
    store = model_store_create("", 1000, bench.arena);
    ck_assert(!model_store_begin_load(store, 0));
    arena_destroy(bench.arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_is_saved_comes_back, a_damaged_file_is_refused,
                                  a_model_of_other_parameters_is_refused,
                                  without_a_directory_saving_is_refused};

    return SUITE_RUN("model_store", tests);
}
