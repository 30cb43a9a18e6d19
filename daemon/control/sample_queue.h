/* Training samples on their way to the learner: a bounded queue that is emptied in the slack of
 * the tick. What it cannot hold is counted, never waited for. */
#ifndef REACH_DAEMON_CONTROL_SAMPLE_QUEUE_H
#define REACH_DAEMON_CONTROL_SAMPLE_QUEUE_H

#include "common/base/arena.h"
#include "daemon/config/sizes.h"
#include "learner/learner.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sample_queue {
    int capacity;
    int oldest;
    int count;       /* samples that wait */
    int64_t learned; /* samples handed to the learner */
    int64_t dropped; /* samples that the queue could not hold */
    struct queued_sample *samples;
};

struct queued_sample {
    double z[MAX_JOINTS];
    double x[MAX_OUTPUTS];
};

size_t sample_queue_memory(int capacity);

/* The queue's samples come from the arena. Returns 0, or -1 when the arena is full. */
int sample_queue_init(struct sample_queue *queue, int capacity, struct arena *arena);

/* Queues a copy of z[n_inputs], x[n_outputs]. */
void sample_queue_add(struct sample_queue *queue, const double *z, int n_inputs, const double *x,
                      int n_outputs);

/* The sample that is next; NULL when none waits. */
const struct queued_sample *sample_queue_oldest(const struct sample_queue *queue);

/* Hands the oldest sample, of which there is one, to the learner. Returns what became of it. */
enum learner_update_result sample_queue_learn_one(struct sample_queue *queue,
                                                  struct learner *learner);

#endif
