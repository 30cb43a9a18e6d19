/* What reachd and reach-finder tell each other of bodies. The first byte says which: an answer,
 * whose fingerprint and checksum are made right, so that its numbers are looked at; or a request.
 * Whatever is let through can be learned on and predicted with, or searched in. */
#include "harness.h"
#include "learner/bus/body_answer.h"
#include "learner/finder/question.h"

#include "common/base/checksum.h"

#include <math.h>
#include <reach_body_t.h>
#include <stdlib.h>
#include <string.h>

static struct learner_config config_of(const struct body *body)
{
    struct learner_config config = learner_config_default(body->chain.n, BODY_OUTPUTS);

    config.features = LEARNER_BODY;
    config.degree = 1;
    config.capacity = 2;
    config.body.space = body->sees ? LEARNER_BODY_EYES : LEARNER_BODY_PLACE;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        config.psi0[i] = 1e-4;
    for (int i = 0; i < body->chain.n; i++)
        config.sigma0[i] = 1;
    return config;
}

static void stand_on(const struct body *body)
{
    static struct learner_prediction prediction;
    const struct learner_config config = config_of(body);
    struct arena *arena = arena_create(learner_memory(&config));
    char why[200];
    struct learner *learner = learner_create(&config, arena, why, sizeof why);
    double z[LEARNER_MAX_INPUTS] = {0};
    double x[BODY_OUTPUTS] = {0.1, 0.2, 0.3};

    HARNESS_REQUIRE(learner != NULL);
    for (int i = 0; i < 4; i++) {
        z[0] = 0.3 * i;
        learner_update(learner, z, x);
    }
    HARNESS_REQUIRE(learner_give_body(learner, body, why, sizeof why) == 0);
    learner_update(learner, z, x);
    learner_predict(learner, z, &prediction);
    HARNESS_REQUIRE(prediction.n_solutions >= 0 && prediction.n_solutions <= LEARNER_MAX_SOLUTIONS);
    arena_destroy(arena);
}

static void put(unsigned char *bytes, uint64_t number, int n)
{
    for (int i = 0; i < n; i++)
        bytes[i] = (unsigned char)(number >> 8 * (n - 1 - i));
}

/* What the input lacks is zero. */
static void hear_answer(const uint8_t *data, size_t size)
{
    static unsigned char bytes[1 << 16];
    static reach_body_t message;
    static struct received_body received;
    const size_t whole = (size_t)reach_body_t_encoded_size(&message);

    HARNESS_REQUIRE(whole <= sizeof bytes);
    memset(bytes, 0, whole);
    memcpy(bytes + 8, data, size < whole - 8 ? size : whole - 8);
    put(bytes, (uint64_t)__reach_body_t_get_hash(), 8);
    HARNESS_REQUIRE(reach_body_t_decode(bytes, 0, (int)whole, &message) == (int)whole);
    put(bytes + whole - sizeof message.numbers - 4,
        checksum_crc32(message.numbers, sizeof message.numbers), 4);
    if (body_answer_read(bytes, whole, &received) && received.answer.kind == BODY_ANSWER_REPORT &&
        received.answer.report.outcome == FINDER_FOUND)
        stand_on(&received.answer.body);
}

static void hear_request(const uint8_t *data, size_t size)
{
    unsigned char *bytes = malloc(size + 8);
    struct question_name name;
    char why[160] = "";
    struct question *question;

    put(bytes, (uint64_t)__reach_body_request_t_get_hash(), 8);
    memcpy(bytes + 8, data, size);
    question = question_read(bytes, size + 8, &name, why, sizeof why);
    HARNESS_REQUIRE(question || why[0]);
    for (int c = 0; question && c < question->n_contexts; c++)
        for (int i = 0; i < question->contexts[c].n * BODY_OUTPUTS; i++)
            HARNESS_REQUIRE(isfinite(question->contexts[c].x[i]));
    question_free(question);
    free(bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
        return 0;
    if (data[0] % 2)
        hear_request(data + 1, size - 1);
    else
        hear_answer(data + 1, size - 1);
    return 0;
}
