#include "daemon/control/sample_queue.h"

#include <string.h>

size_t training_memory(int capacity)
{
    return arena_footprint(sizeof(struct training_sample) * (size_t)capacity);
}

int training_init(struct training *training, int capacity, struct arena *arena)
{
    memset(training, 0, sizeof *training);
    training->capacity = capacity;
    training->samples = arena_alloc(arena, sizeof(struct training_sample) * (size_t)capacity);
    return training->samples ? 0 : -1;
}

void training_add(struct training *training, const double *z, int n_inputs, const double *x,
                  int n_outputs)
{
    struct training_sample *sample;

    if (training->count == training->capacity) {
        training->dropped++;
        return;
    }
    sample = &training->samples[(training->oldest + training->count) % training->capacity];
    memcpy(sample->z, z, sizeof(double) * (size_t)n_inputs);
    memcpy(sample->x, x, sizeof(double) * (size_t)n_outputs);
    training->count++;
}

const struct training_sample *training_oldest(const struct training *training)
{
    return training->count > 0 ? &training->samples[training->oldest] : NULL;
}

bool training_learn_one(struct training *training, struct learner *learner)
{
    const struct training_sample *sample = training_oldest(training);

    if (!sample)
        return false;
    learner_update(learner, sample->z, sample->x);
    training->oldest = (training->oldest + 1) % training->capacity;
    training->count--;
    training->learned++;
    return true;
}
