#include "body_bench.h"

#include "learner/store/model_file.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

struct body_bench_finder body_bench_finder;
uint64_t body_bench_moves_at = UINT64_MAX;

/* Shoulder up and elbow across, links of 0.3 m. */
static void make_body(struct body *body)
{
    memset(body, 0, sizeof *body);
    body->chain.n = 2;
    body->chain.axis[0][2] = body->chain.axis[1][1] = 1;
    body->chain.offset[1][0] = 0.3;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        body->noise[i] = 1e-3;
    body->length = 0.4;
    body->gravity[2] = -1;
    body->range[0] = body->range[1] = 1;
    body->samples = 20;
    body->error = 1;
}

static void ask(void *user, const struct body_search *search)
{
    (void)user;
    body_bench_finder.asked++;
    body_bench_finder.seq = search->seq;
    body_bench_finder.started = search->settings.start != NULL;
    body_bench_finder.samples = 0;
    for (int c = 0; c < search->n_contexts; c++)
        body_bench_finder.samples += search->contexts[c].n;
    body_bench_finder.came = body_bench_finder.answered = false;
}

static void ask_again(void *user)
{
    (void)user;
    body_bench_finder.again++;
}

static bool take(void *user, struct body_answer *answer)
{
    struct body_bench_finder *finder = &body_bench_finder;

    (void)user;
    if (finder->absent || finder->answered || finder->asked == 0 || (finder->came && finder->slow))
        return false;
    memset(answer, 0, sizeof *answer);
    answer->seq = finder->seq;
    answer->kind = finder->came ? BODY_ANSWER_REPORT : BODY_ANSWER_COMES;
    finder->answered = finder->came;
    finder->came = true;
    answer->report.outcome = finder->outcome;
    answer->checksum = 0xB0D1;
    make_body(&answer->body);
    return true;
}

static void tell(void *user, const struct body *body)
{
    (void)user;
    ck_assert_int_eq(body->chain.n, 2);
    body_bench_finder.told++;
}

const struct finder_port body_bench_port = {
    .ask = ask, .ask_again = ask_again, .take = take, .tell = tell};

struct model_store_settings body_bench_settings(const char *directory)
{
    struct model_store_settings settings = store_bench_settings(directory, NULL);

    settings.learner = learner_config_default(2, BODY_OUTPUTS);
    settings.learner.features = LEARNER_BODY;
    settings.learner.degree = 2;
    settings.learner.capacity = 4;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        settings.learner.psi0[i] = 1e-4;
    settings.learner.sigma0[0] = settings.learner.sigma0[1] = 1;
    settings.finder = &body_bench_port;
    body_bench_finder = (struct body_bench_finder){0};
    body_bench_moves_at = UINT64_MAX;
    return settings;
}

/* A tip of 0.2 m on the chain, and some noise. */
void body_bench_sample(uint64_t number, double *z, double *x)
{
    uint64_t scrambled = number * 0x9E3779B97F4A7C15ULL;
    const double tip[3] = {0.2, 0, 0.01};
    struct chain_pose pose;
    struct body body;

    make_body(&body);
    z[0] = (double)(scrambled >> 40) * 0x1p-23 - 1;
    z[1] = (double)(scrambled >> 16 & 0xFFFFFF) * 0x1p-23 - 1;
    if (number >= body_bench_moves_at)
        body.chain.offset[0][1] += 0.02;
    chain_at(&body.chain, z, &pose);
    for (int row = 0; row < 3; row++) {
        const double *turn = &pose.turn[2][3 * row];
        x[row] = pose.p[row] + turn[0] * tip[0] + turn[1] * tip[1] + turn[2] * tip[2] +
                 (double)(scrambled >> row & 0xFFF) * 0x1p-22;
    }
}

bool body_bench_learn_one(struct store_bench *bench)
{
    double z[2], x[BODY_OUTPUTS];

    body_bench_sample(model_samples(bench->learner) + 1, z, x);
    if (!model_store_note(bench->store, z, x))
        return false;
    learner_update(bench->learner, z, x);
    model_store_learned(bench->store, bench->learner);
    return true;
}

uint64_t body_bench_tick(struct store_bench *bench)
{
    uint64_t given = 0;

    model_store_poll(bench->store, &bench->learner);
    if (model_store_moment(bench->store).body > 0) {
        ck_assert_uint_eq(model_store_moment(bench->store).body_checksum, 0xB0D1);
        given = model_samples(bench->learner);
    }
    body_bench_learn_one(bench);
    return given;
}

struct body body_bench_body(void)
{
    struct body body;

    make_body(&body);
    return body;
}

uint64_t body_bench_hash_at(const struct model_store_settings *settings, uint64_t samples,
                            const uint64_t *given, int n)
{
    return body_bench_hash_forgetting(settings, samples, given, n, UINT64_MAX);
}

uint64_t body_bench_hash_forgetting(const struct model_store_settings *settings, uint64_t samples,
                                    const uint64_t *given, int n, uint64_t taken)
{
    static const struct body none;
    struct store_bench bench = {.arena = arena_create(learner_memory(&settings->learner))};
    char error[200];
    struct body body;
    double z[2], x[BODY_OUTPUTS];
    uint64_t hash;

    make_body(&body);
    bench.learner = learner_create(&settings->learner, bench.arena, error, sizeof error);
    ck_assert_msg(bench.learner != NULL, "%s", error);
    for (uint64_t number = 1; number <= samples; number++) {
        body_bench_sample(number, z, x);
        learner_update(bench.learner, z, x);
        for (int i = 0; i < n; i++)
            if (given[i] == number)
                ck_assert_int_eq(learner_give_body(bench.learner, &body, error, sizeof error), 0);
        if (number == taken)
            ck_assert_int_eq(learner_give_body(bench.learner, &none, error, sizeof error), 0);
    }
    hash = store_bench_hash(&bench);
    arena_destroy(bench.arena);
    return hash;
}
