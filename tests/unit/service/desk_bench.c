#include "desk_bench.h"

#include "common/program/log.h"
#include "tests/unit/store/fake_disk.h"

#include <check.h>
#include <math.h>

struct desk_bench on;

static int64_t newest; /* number of a request */

enum desk_answer desk_bench_take(const reach_learner_request_t *request)
{
    return desk_take(on.desk, request, 0, NOW, &on.output);
}

int desk_bench_status(const reach_learner_request_t *request)
{
    ck_assert_int_eq(desk_bench_take(request), DESK_REPLY);
    ck_assert_int_eq(on.output.reply.client, request->client);
    ck_assert_int_eq(on.output.reply.seq, request->seq);
    ck_assert_int_eq(on.output.reply.utime, NOW);
    return on.output.reply.status;
}

reach_learner_request_t desk_bench_request(int8_t kind)
{
    reach_learner_request_t request = {.client = CLIENT,
                                       .seq = ++newest,
                                       .kind = kind,
                                       .n_inputs = on.settings.learner.n_inputs,
                                       .n_outputs = on.settings.learner.n_outputs};

    for (int i = 0; i < request.n_inputs; i++)
        request.z[i] = sin(0.7 * (double)newest + i);
    for (int i = 0; i < request.n_outputs; i++)
        request.x[i] = cos(0.3 * (double)newest + i);
    return request;
}

static void introduce(void)
{
    const reach_learner_request_t request = desk_bench_request(REQUEST(STATISTICS));

    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    ck_assert_int_eq(on.output.reply.n_inputs, on.settings.learner.n_inputs);
    ck_assert_int_eq(on.output.reply.n_outputs, on.settings.learner.n_outputs);
}

void desk_bench_open(struct model_store_settings settings)
{
    const bool keeps = settings.directory[0];

    log_open("test", LOG_LEVEL_ERROR - 1);
    on.settings = settings;
    on.bench = store_bench_create(&on.settings);
    on.desk = desk_create(&on.settings.learner, on.bench.learner, on.bench.store, keeps,
                          arena_create(desk_memory()));
    ck_assert_ptr_nonnull(on.desk);
    if (keeps)
        store_bench_serve(&on.bench);
    introduce();
}

void desk_bench_forgetful(void)
{
    desk_bench_open(store_bench_settings("", &fake_disk_files));
}

void desk_bench_keeping(void)
{
    fake_disk_reset(random_seed(1));
    desk_bench_open(store_bench_settings(FAKE_DISK_DIRECTORY, &fake_disk_files));
}

void desk_bench_learn(int samples)
{
    for (int i = 0; i < samples; i++) {
        const reach_learner_request_t request = desk_bench_request(REQUEST(UPDATE));
        ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    }
}
