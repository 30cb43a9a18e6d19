/* What implementations of a learner need; see learner.h. Checks that all share (finite numbers,
 * dimensions, counts) are made once, in learner.c. */
#ifndef REACH_LEARNER_KIND_H
#define REACH_LEARNER_KIND_H

#include "learner/learner.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Features beyond this are refused: their squares must stay far from the end of a double's range.
 */
#define LEARNER_LARGEST_FEATURE 1e60

struct learner_ops {
    uint64_t number; /* of the kind in a saved state and its hash; never that of another */
    /* 0, or -1 and a line in err; ranges of rows that are one number have been checked. */
    int (*check)(const struct learner_config *config, char *err, size_t err_size);
    /* Continues learner_config_hash() with the rows that are this kind's own. */
    uint64_t (*hash)(const struct learner_config *config, uint64_t hash);
    size_t (*memory)(const struct learner_config *config);
    /* The implementation's own state, or NULL when the arena is exhausted. */
    void *(*create)(const struct learner_config *config, struct arena *arena);
    enum learner_update_result (*update)(void *self, const double *z, const double *x);
    int (*predict)(void *self, const double *z, struct learner_prediction *prediction);
    int (*predict_single)(void *self, const double *z, struct learner_solution *solution);
    int (*predict_inverse)(void *self, const double *x, struct learner_inverse *inverse);
    int (*experts)(const void *self);
    /* Experts that state_size() counts; NULL where they are those of experts(). */
    int (*saved_experts)(const void *self);
    /* Bytes of a state with that many experts, without the wrapper's header. */
    size_t (*state_size)(const void *self, int n_experts);
    void (*save)(const void *self, unsigned char *buffer);
    /* NULL for learners that stand on no body; see learner_give_body() and what follows it. */
    int (*give_body)(void *self, const struct body *body, char *err, size_t err_size);
    const struct body *(*body)(const void *self);
    int (*not_rigid)(void *self, double *share);
    struct learner_body_change (*body_change)(const void *self);
    struct learner_samples (*kept_samples)(const void *self, int context);
    /* The wrapper has checked the number of experts, the size and the checksum. 0, or -1 and a line
     * in err with the state as it was. */
    int (*load)(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size);
};

extern const struct learner_ops learner_imle_ops;
extern const struct learner_ops learner_body_ops; /* IMLE until a body is found */
extern const struct learner_ops learner_lwpr_ops;

/* Defaults of config.lwpr. */
struct learner_lwpr_config learner_lwpr_default(int n_inputs);

/* The implementation that a configuration asks for; NULL for a kind that is none. */
const struct learner_ops *learner_ops_of(const struct learner_config *config);

/* A hash (FNV-1a) of all that gives a saved state its meaning: every row but the capacity and those
 * that only shape predictions. */
uint64_t learner_config_hash(const struct learner_config *config);

#ifdef __cplusplus
}
#endif
#endif
