/* A warm restart at capacity: the largest model that a start may have to read, and the longest
 * journal behind it, on the real file system. */
#include "common/base/random.h"
#include "daemon/config/sizes.h"
#include "learner/store/model_file.h"
#include "learner/store/store.h"
#include "store_bench.h"
#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static const double start_within = 0.7; /* s; the bus asks for 0.3 s more (bus_claim_role) */

static double cpu_seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

/* Tool number `tool` gives each of them an expert of its own. */
static void teach(struct store_bench *bench, struct random_state *random, int n_inputs, int tool)
{
    double z[MAX_JOINTS], x[MAX_OUTPUTS];

    for (int i = 0; i < n_inputs; i++)
        z[i] = random_uniform(random, -1, 0);
    x[0] = z[0] + 0.5 * tool;
    x[1] = z[1] - 0.5 * tool;
    x[2] = 100 * (z[2] + z[3]) + 50.0 * tool;
    ck_assert(model_store_note(bench->store, z, x));
    learner_update(bench->learner, z, x);
    if (model_store_full(bench->store))
        store_bench_serve(bench);
}

/* Instrumented programs take longer, cmake/ReachTest.cmake. */
static double patience(void)
{
    const char *given = getenv("CK_TIMEOUT_MULTIPLIER");

    return given ? atof(given) : 1;
}

START_TEST(a_full_model_starts_in_time)
{
    const char *const overrides[] = {"learner.capacity=1024", "learner.births=published"};
    const struct config config = fixture_config(overrides, 2);
    struct random_state random = fixture_random("model_start");
    char directory[] = "/tmp/reach-start-XXXXXX";
    struct model_store_settings settings;
    struct store_bench bench;
    int capacity; /* as many as fit into learner.most_bytes */
    uint64_t hash;
    double begin;

    ck_assert_ptr_nonnull(mkdtemp(directory));
    settings = store_bench_settings(directory, NULL);
    settings.learner = config_learner(&config);
    settings.snapshot_samples = config.model_snapshot;
    bench = store_bench_create(&settings);
    capacity = learner_get_statistics(bench.learner).capacity;
    for (int i = 0; learner_get_statistics(bench.learner).experts < capacity; i++)
        teach(&bench, &random, settings.learner.n_inputs, i / 3);
    store_bench_close(&bench);
    bench = store_bench_create(&settings);
    store_bench_serve(&bench); /* the snapshot; then as long a journal as there can be */
    for (int i = 0; i < settings.snapshot_samples - 1; i++)
        teach(&bench, &random, settings.learner.n_inputs, i);
    hash = store_bench_hash(&bench);
    store_bench_close(&bench);

    begin = cpu_seconds();
    bench = store_bench_create(&settings);
    begin = cpu_seconds() - begin;
    printf("model_start: %d experts, %.1f MB, %d samples of journal: %.3f s of processor time\n",
           capacity, (double)learner_save_size(bench.learner) * 1e-6, settings.snapshot_samples - 1,
           begin);
    ck_assert_uint_eq(store_bench_hash(&bench), hash);
    ck_assert_double_lt(begin, start_within * patience());
    store_bench_close(&bench);
    store_bench_remove(directory);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {a_full_model_starts_in_time};

    return SUITE_RUN("model_start", tests);
}
