/* The uninterrupted run: a learner that is given the samples that daemons announced, one after the
 * other, and the bodies that they took, and is never killed. */
#ifndef REACH_TEST_REFERENCE_H
#define REACH_TEST_REFERENCE_H

#include "daemon/config/config.h"
#include "learner/body/chain/body.h"
#include "learner/store/model_file.h"

#include <reach_sample_t.h>
#include <stdbool.h>
#include <stdint.h>

#define REFERENCE_MOST 200000
#define REFERENCE_BODIES 500

/* A body that a learner had from so many samples on; one of no joints: it had none any more. */
struct reference_body {
    uint64_t number;
    struct body body;
};

struct reference {
    struct arena *arena;
    struct learner *learner;
    struct model_bytes empty; /* the learner before its first sample */
    uint64_t learned;         /* samples given to the learner */
    uint64_t heard;           /* samples announced, those that the learner has learned among them */
    struct {
        double z[16], x[8];
    } * samples; /* in order, from number 1 at index 0 */

    struct reference_body *bodies; /* that were told of, oldest first */
    int n_bodies;
    int given; /* those that the learner was given */
    /* One that was found and may have been taken, with no fewer than `told` samples. */
    bool maybe;
    struct body found;
    uint64_t told;
};

void reference_init(struct reference *reference, const struct config *config);

/* It knows nothing again. */
void reference_forget(struct reference *reference);

/* The next sample; as robot_sample_fn with the reference as `user`. */
void reference_hear(void *reference, const reach_sample_t *sample);

/* The daemon said that it has taken this body. */
void reference_give(struct reference *reference, uint64_t number, const struct body *body);

/* The daemon has gone back to so many samples, with a model of this hash: later ones never were.
 * Returns whether the uninterrupted learner's is the same there, with the body that may have been
 * taken or without it; `maybe` then says whether it was. `number` may not be less than at the call
 * before, nor more than was heard. */
bool reference_agrees(struct reference *reference, uint64_t number, uint64_t hash);

#endif
