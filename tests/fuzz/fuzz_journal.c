/* A journal of learned samples and bodies. They come in order, and a refusal has a reason. */
#include "harness.h"
#include "learner/store/journal.h"
#include "learner/store/model_file.h"

#include <string.h>

static void visit(void *user, const struct journal_sample *sample)
{
    uint64_t *number = (uint64_t *)user;

    HARNESS_REQUIRE(sample->number == *number + 1);
    *number = sample->number;
}

static const char *visit_body(void *user, const struct journal_body *body)
{
    HARNESS_REQUIRE(body->number == *(const uint64_t *)user);
    return NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint64_t number = 0;
    struct journal_reading reading = {.model = 0, .number = 0};
    const struct journal_visitor visitor = {visit, visit_body, &number};
    char reason[MODEL_REASON_MOST] = "";
    const char *path = harness_file(data, size);

    if (journal_read(&files_system, path, &reading, &visitor, reason, sizeof reason) == 0)
        HARNESS_REQUIRE(reading.number == number);
    else
        HARNESS_REQUIRE(reason[0]);
    journal_is_empty(&files_system, path);
    return 0;
}
