/* The uninterrupted run: a learner that is given the samples that daemons announced, one after the
 * other, and is never killed, saved or loaded. */
#ifndef REACH_TEST_REFERENCE_H
#define REACH_TEST_REFERENCE_H

#include "daemon/config/config.h"

#include <reach_sample_t.h>
#include <stdbool.h>
#include <stdint.h>

#define REFERENCE_MOST 200000

struct reference {
    struct arena *arena;
    struct learner *learner;
    uint64_t learned; /* samples given to the learner */
    uint64_t heard;   /* samples announced, those that the learner has learned among them */
    struct {
        double z[16], x[8];
    } * samples; /* in order, from number 1 at index 0 */
};

void reference_init(struct reference *reference, const struct config *config);

/* The next sample; as robot_sample_fn with the reference as `user`. */
void reference_hear(void *reference, const reach_sample_t *sample);

/* The daemon has gone back to so many samples: later ones never were. Returns the model's hash
 * there. `number` may not be less than at the call before, nor more than was heard. */
uint64_t reference_return_to(struct reference *reference, uint64_t number);

#endif
