/* A model: the file with its checks, and the learner's bytes without, since a checksum would keep
 * nearly all damage from the code behind it. What is taken predicts, learns and is saved again. */
#include "common/base/arena.h"
#include "harness.h"
#include "learner/learner.h"
#include "learner/store/model_file.h"

#include <string.h>

enum { INPUTS = 2, OUTPUTS = 2, MOST_BYTES = 1 << 16 };

static struct arena *arena;
static struct learner *learner;

static void begin(void)
{
    struct learner_config config = learner_config_default(INPUTS, OUTPUTS);
    char error[256];

    config.capacity = 4;
    for (int i = 0; i < INPUTS; i++)
        config.sigma0[i] = config.scale[i] = 1;
    for (int i = 0; i < OUTPUTS; i++)
        config.psi0[i] = 0.01;
    arena = arena_create(learner_memory(&config));
    HARNESS_REQUIRE(arena);
    learner = learner_create(&config, arena, error, sizeof error);
    HARNESS_REQUIRE(learner);
}

static void use(void)
{
    static struct learner_prediction prediction;
    static uint8_t saved[MOST_BYTES];
    const double z[INPUTS] = {0.1, -0.2}, x[OUTPUTS] = {0.3, 0.4};

    learner_predict(learner, z, &prediction);
    learner_update(learner, z, x);
    HARNESS_REQUIRE(learner_save_size(learner) <= sizeof saved);
    HARNESS_REQUIRE(learner_save(learner, saved, sizeof saved) == learner_save_size(learner));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t bytes[MOST_BYTES];
    struct model_bytes model = {.bytes = bytes, .capacity = sizeof bytes};
    char reason[MODEL_REASON_MOST] = "";

    if (!learner)
        begin();
    if (learner_load(learner, data, size, reason, sizeof reason) == 0)
        use();
    else
        HARNESS_REQUIRE(reason[0]);
    if (model_file_read(&files_system, harness_file(data, size), &model, reason, sizeof reason) ==
        MODEL_FILE_READ)
        HARNESS_REQUIRE(model.size <= sizeof bytes && model.hash == model_hash(bytes, model.size));
    return 0;
}
