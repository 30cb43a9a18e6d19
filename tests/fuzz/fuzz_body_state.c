/* The state of a learner on a body, with numbers of it replaced and sealed again: its checksum
 * would keep all other damage from the code behind. The input is a list of changes, 10 bytes each:
 * which number (2 bytes, of the first 65536 or of any), and what it becomes. What is taken
 * predicts, learns and is saved again. */
#include "common/base/arena.h"
#include "harness.h"
#include "learner/base/hash.h"
#include "learner/body/chain/body.h"

#include <string.h>

enum { JOINTS = 2, CHANGE = 10, MOST_CHANGES = 64, ENVELOPE = 14 * sizeof(uint64_t) };

static struct arena *arena;
static struct learner *learner;
static uint8_t *state;   /* as it was saved */
static uint8_t *changed; /* the same with changes */
static size_t size;      /* of both */
static size_t most; /* that a state may have: one whose body is doubtful holds polynomials, too */

static struct body small_body(void)
{
    struct body body = {.chain = {.n = JOINTS,
                                  .axis = {{0, 0, 1}, {0, 1, 0}},
                                  .offset = {{0, 0, 0.1}, {0.3, 0, 0}}},
                        .noise = {1e-3, 1e-3, 1e-3},
                        .length = 0.3,
                        .gravity = {0, 0, -1},
                        .range = {1, 1}};
    int n = body_unknowns(&body);

    for (int i = 0; i < n; i++)
        body.root[i * (i + 1) / 2 + i] = 1e-5;
    return body;
}

static void begin(void)
{
    struct learner_config config = learner_config_default(JOINTS, BODY_OUTPUTS);
    struct body body = small_body();
    char error[256];

    config.features = LEARNER_BODY;
    config.degree = 2;
    config.capacity = 4;
    for (int i = 0; i < JOINTS; i++)
        config.sigma0[i] = config.scale[i] = 1;
    for (int i = 0; i < BODY_OUTPUTS; i++)
        config.psi0[i] = 1e-4;
    arena = arena_create(learner_memory(&config));
    HARNESS_REQUIRE(arena);
    learner = learner_create(&config, arena, error, sizeof error);
    HARNESS_REQUIRE(learner);
    HARNESS_REQUIRE(learner_give_body(learner, &body, error, sizeof error) == 0);
    for (int k = 0; k < 40; k++) {
        double z[JOINTS] = {0.1 * (k % 7) - 0.3, 0.2 * (k % 5) - 0.4};
        double x[BODY_OUTPUTS] = {0.5 + 0.2 * (k % 2), 0.1 * z[0], 0.4 - 0.5 * z[1]};
        learner_update(learner, z, x);
    }
    size = learner_save_size(learner);
    most = learner_memory(&config);
    state = malloc(size);
    changed = malloc(most);
    HARNESS_REQUIRE(state && changed && learner_save(learner, state, size) == size);
}

static void change(const uint8_t *data, size_t length)
{
    size_t numbers = (size - ENVELOPE) / sizeof(double);
    uint64_t hash;

    memcpy(changed, state, size);
    for (size_t i = 0; i + CHANGE <= length && i < MOST_CHANGES * CHANGE; i += CHANGE) {
        size_t which = (size_t)data[i] << 8 | data[i + 1];
        which = which % 2 ? which / 2 : which * numbers / 65536;
        memcpy(changed + ENVELOPE + which % numbers * sizeof(double), data + i + 2, sizeof(double));
    }
    hash = learner_hash(LEARNER_HASH_START, changed + ENVELOPE, size - ENVELOPE);
    hash = learner_hash(hash, changed, ENVELOPE - sizeof hash);
    memcpy(changed + ENVELOPE - sizeof hash, &hash, sizeof hash);
}

static void use(void)
{
    static struct learner_prediction prediction;
    static struct learner_inverse inverse;
    const double z[JOINTS] = {0.1, -0.2}, x[BODY_OUTPUTS] = {0.5, 0.1, 0.2};

    learner_predict(learner, z, &prediction);
    HARNESS_REQUIRE(prediction.n_solutions <= LEARNER_MAX_SOLUTIONS);
    learner_predict_inverse(learner, x, &inverse);
    for (int k = 0; k < 5; k++)
        learner_update(learner, z, x);
    HARNESS_REQUIRE(learner_save_size(learner) >= size && learner_save_size(learner) <= most);
    HARNESS_REQUIRE(learner_save(learner, changed, most) == learner_save_size(learner));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t length)
{
    char reason[256] = "";

    if (!learner)
        begin();
    change(data, length);
    if (learner_load(learner, changed, size, reason, sizeof reason) == 0)
        use();
    else
        HARNESS_REQUIRE(reason[0]);
    return 0;
}
