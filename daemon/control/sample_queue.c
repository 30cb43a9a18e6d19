#include "daemon/control/sample_queue.h"

#include <string.h>

size_t sample_queue_memory(int capacity)
{
    return arena_footprint(sizeof(struct queued_sample) * (size_t)capacity);
}

int sample_queue_init(struct sample_queue *queue, int capacity, struct arena *arena)
{
    memset(queue, 0, sizeof *queue);
    queue->capacity = capacity;
    queue->samples = arena_alloc(arena, sizeof(struct queued_sample) * (size_t)capacity);
    return queue->samples ? 0 : -1;
}

void sample_queue_add(struct sample_queue *queue, const double *z, int n_inputs, const double *x,
                      int n_outputs)
{
    struct queued_sample *sample;

    if (queue->count == queue->capacity) {
        queue->dropped++;
        return;
    }
    sample = &queue->samples[(queue->oldest + queue->count) % queue->capacity];
    memcpy(sample->z, z, sizeof(double) * (size_t)n_inputs);
    memcpy(sample->x, x, sizeof(double) * (size_t)n_outputs);
    queue->count++;
}

const struct queued_sample *sample_queue_oldest(const struct sample_queue *queue)
{
    return queue->count > 0 ? &queue->samples[queue->oldest] : NULL;
}

enum learner_update_result sample_queue_learn_one(struct sample_queue *queue,
                                                  struct learner *learner)
{
    const struct queued_sample *sample = sample_queue_oldest(queue);
    enum learner_update_result result = learner_update(learner, sample->z, sample->x);

    queue->oldest = (queue->oldest + 1) % queue->capacity;
    queue->count--;
    queue->learned++;
    return result;
}
