#include "store_bench.h"

#include "learner/store/model_file.h"

#include <check.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

struct model_store_settings store_bench_settings(const char *directory, const struct files *files)
{
    struct model_store_settings settings = {.directory = directory,
                                            .automatic = true,
                                            .snapshot_samples = 10,
                                            .sync_us = 0,
                                            .keep = 2,
                                            .learner = learner_config_default(2, 1),
                                            .files = files};

    settings.learner.psi0[0] = 0.01;
    settings.learner.sigma0[0] = settings.learner.sigma0[1] = 1;
    settings.learner.capacity = 8;
    return settings;
}

struct store_bench store_bench_try(const struct model_store_settings *settings, char *error,
                                   size_t error_size)
{
    struct store_bench bench = {.now = 1000000};

    bench.arena = arena_create(learner_memory(&settings->learner) + model_store_memory());
    bench.learner = learner_create(&settings->learner, bench.arena, error, error_size);
    ck_assert_msg(bench.learner != NULL, "%s", error);
    bench.store = model_store_create(settings, bench.arena, error, error_size);
    ck_assert_msg(bench.store != NULL, "%s", error);
    if (model_store_open(bench.store, bench.learner, error, error_size)) {
        model_store_close(bench.store);
        arena_destroy(bench.arena);
        bench.store = NULL;
    }
    return bench;
}

struct store_bench store_bench_create(const struct model_store_settings *settings)
{
    char error[MODEL_REASON_MOST];
    struct store_bench bench = store_bench_try(settings, error, sizeof error);

    ck_assert_msg(bench.store != NULL, "%s", error);
    return bench;
}

/* A map with two values and some noise, so that experts are born and outliers dropped. */
static void sample(uint64_t number, double *z, double *x)
{
    uint64_t scrambled = number * 0x9E3779B97F4A7C15ULL;

    z[0] = (double)(scrambled >> 40) * 0x1p-23 - 1;
    z[1] = (double)(scrambled >> 16 & 0xFFFFFF) * 0x1p-23 - 1;
    x[0] = z[0] * (1 + z[1]) + (double)(scrambled & 0xFFFF) * 0x1p-20 + (number / 25 % 2 ? 2 : 0);
}

bool store_bench_learn_one(struct store_bench *bench)
{
    double z[2], x[1];

    sample(model_samples(bench->learner) + 1, z, x);
    if (!model_store_note(bench->store, z, x))
        return false;
    learner_update(bench->learner, z, x);
    return true;
}

void store_bench_learn(struct store_bench *bench, int samples)
{
    for (int i = 0; i < samples; i++)
        ck_assert(store_bench_learn_one(bench));
}

void store_bench_serve(struct store_bench *bench)
{
    bench->now += 1000000;
    model_store_serve(bench->store, bench->now);
}

static uint64_t hash_of(const struct learner *learner)
{
    struct model_bytes model = {.capacity = learner_save_size(learner)};

    model.bytes = malloc(model.capacity);
    model_capture(&model, learner);
    free(model.bytes);
    return model.hash;
}

uint64_t store_bench_hash(const struct store_bench *bench)
{
    return hash_of(bench->learner);
}

static pthread_t house;
static _Atomic bool ending;

static void *keep_house(void *user)
{
    struct store_bench *bench = user;
    int64_t now = 1;

    while (!atomic_load_explicit(&ending, memory_order_relaxed))
        model_store_serve(bench->store, now += 1000);
    return NULL;
}

void store_bench_keep_house(struct store_bench *bench)
{
    atomic_store(&ending, false);
    ck_assert_int_eq(pthread_create(&house, NULL, keep_house, bench), 0);
}

void store_bench_end_house(void)
{
    atomic_store(&ending, true);
    pthread_join(house, NULL);
}

void store_bench_close(struct store_bench *bench)
{
    model_store_close(bench->store);
    arena_destroy(bench->arena);
}

uint64_t store_bench_hash_at(const struct model_store_settings *settings, uint64_t samples)
{
    struct arena *arena = arena_create(learner_memory(&settings->learner));
    char error[200];
    struct learner *learner = learner_create(&settings->learner, arena, error, sizeof error);
    uint64_t hash;
    double z[2], x[1];

    for (uint64_t number = 1; number <= samples; number++) {
        sample(number, z, x);
        learner_update(learner, z, x);
    }
    hash = hash_of(learner);
    arena_destroy(arena);
    return hash;
}

static void remove_one(void *user, const char *name)
{
    const char *const *directory = user;
    char path[MODEL_PATH_MOST];

    snprintf(path, sizeof path, "%s/%s", *directory, name);
    unlink(path);
}

void store_bench_remove(const char *directory)
{
    files_system.list(directory, remove_one, &directory);
    ck_assert_int_eq(rmdir(directory), 0);
}
