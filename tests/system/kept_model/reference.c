#include "reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct model_bytes capture(const struct reference *reference)
{
    struct model_bytes model = {.capacity = learner_save_size(reference->learner)};

    model.bytes = malloc(model.capacity);
    model_capture(&model, reference->learner);
    return model;
}

void reference_init(struct reference *reference, const struct config *config)
{
    const struct learner_config learner = config_learner(config);
    char error[200];

    reference->arena = arena_create(learner_memory(&learner));
    reference->learner = learner_create(&learner, reference->arena, error, sizeof error);
    reference->samples = calloc(REFERENCE_MOST, sizeof *reference->samples);
    reference->bodies = calloc(REFERENCE_BODIES, sizeof *reference->bodies);
    if (!reference->learner || !reference->samples || !reference->bodies) {
        fprintf(stderr, "reference: %s\n", error);
        exit(1);
    }
    reference->empty = capture(reference);
}

static void load(struct reference *reference, const struct model_bytes *model)
{
    char why[200];

    if (learner_load(reference->learner, model->bytes, model->size, why, sizeof why))
        abort();
}

void reference_forget(struct reference *reference)
{
    load(reference, &reference->empty);
    reference->learned = reference->heard = 0;
    reference->n_bodies = reference->given = 0;
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

void reference_give(struct reference *reference, uint64_t number, const struct body *body)
{
    if (reference->n_bodies == REFERENCE_BODIES)
        abort();
    reference->bodies[reference->n_bodies++] = (struct reference_body){number, *body};
}

static void give_to_learner(struct reference *reference, const struct body *body)
{
    char why[200];

    if (learner_give_body(reference->learner, body, why, sizeof why)) {
        fprintf(stderr, "reference: %s\n", why);
        exit(1);
    }
}

static void give_what_is_due(struct reference *reference)
{
    for (; reference->given < reference->n_bodies &&
           reference->bodies[reference->given].number == reference->learned;
         reference->given++)
        give_to_learner(reference, &reference->bodies[reference->given].body);
}

static void learn_up_to(struct reference *reference, uint64_t number)
{
    give_what_is_due(reference);
    while (reference->learned < number) {
        learner_update(reference->learner, reference->samples[reference->learned].z,
                       reference->samples[reference->learned].x);
        reference->learned++;
        give_what_is_due(reference);
    }
}

static uint64_t hash_of(const struct reference *reference)
{
    const struct model_bytes model = capture(reference);

    free(model.bytes);
    return model.hash;
}

/* With the body that may have been taken, from sample `from` on: nobody said so, since the daemon
 * died within that tick. */
static bool agrees_with_found(struct reference *reference, const struct model_bytes *then,
                              uint64_t from, uint64_t number, uint64_t hash)
{
    for (uint64_t at = from; at <= number; at++) {
        load(reference, then);
        reference->learned = from;
        learn_up_to(reference, at);
        give_to_learner(reference, &reference->found);
        learn_up_to(reference, number);
        if (hash_of(reference) == hash)
            return true;
    }
    return false;
}

bool reference_agrees(struct reference *reference, uint64_t number, uint64_t hash)
{
    const bool maybe = reference->maybe;
    uint64_t from = maybe && reference->told < number ? reference->told : number;
    struct model_bytes then;
    bool agrees;

    learn_up_to(reference, from);
    then = capture(reference);
    learn_up_to(reference, number);
    agrees = number == 0 || hash_of(reference) == hash;
    reference->maybe = !agrees;
    if (!agrees && maybe)
        agrees = agrees_with_found(reference, &then, from, number, hash);
    reference->heard = number;
    free(then.bytes);
    return agrees;
}
