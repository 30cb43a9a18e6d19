#include "reference.h"

#include "learner/store/model_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void reference_init(struct reference *reference, const struct config *config)
{
    const struct learner_config learner = config_learner(config);
    char error[200];

    reference->arena = arena_create(learner_memory(&learner));
    reference->learner = learner_create(&learner, reference->arena, error, sizeof error);
    reference->samples = calloc(REFERENCE_MOST, sizeof *reference->samples);
    if (!reference->learner || !reference->samples) {
        fprintf(stderr, "reference: %s\n", error);
        exit(1);
    }
}

void reference_hear(void *user, const reach_sample_t *sample)
{
    struct reference *reference = user;

    if (reference->heard == REFERENCE_MOST)
        abort();
    memcpy(reference->samples[reference->heard].z, sample->q, sizeof sample->q);
    memcpy(reference->samples[reference->heard].x, sample->x, sizeof sample->x);
    reference->heard++;
}

uint64_t reference_return_to(struct reference *reference, uint64_t number)
{
    struct model_bytes model = {0};

    for (; reference->learned < number; reference->learned++)
        learner_update(reference->learner, reference->samples[reference->learned].z,
                       reference->samples[reference->learned].x);
    reference->heard = number;
    model.capacity = learner_save_size(reference->learner);
    model.bytes = malloc(model.capacity);
    model_capture(&model, reference->learner);
    free(model.bytes);
    return model.hash;
}
