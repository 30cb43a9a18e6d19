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
    const char *name;
    /* 0, or -1 and a line in err; rows that all kinds share have been checked. */
    int (*check)(const struct learner_config *config, char *err, size_t err_size);
    size_t (*memory)(const struct learner_config *config);
    /* The implementation's own state, or NULL when the arena is exhausted. */
    void *(*create)(const struct learner_config *config, struct arena *arena);
    enum learner_update_result (*update)(void *self, const double *z, const double *x);
    int (*predict)(void *self, const double *z, struct learner_prediction *prediction);
    int (*predict_single)(void *self, const double *z, struct learner_solution *solution);
    int (*predict_inverse)(void *self, const double *x, struct learner_inverse *inverse);
    int (*experts)(const void *self);
    /* Bytes of a state with that many experts, without the wrapper's header. */
    size_t (*state_size)(const void *self, int n_experts);
    void (*save)(const void *self, unsigned char *buffer);
    /* NULL for learners that stand on no body; see learner_give_body() and what follows it. */
    int (*give_body)(void *self, const struct body *body, char *err, size_t err_size);
    const struct body *(*body)(const void *self);
    struct learner_samples (*kept_samples)(const void *self, int context);
    /* The wrapper has checked the number of experts, the size and the checksum. 0, or -1 and a line
     * in err with the state as it was. */
    int (*load)(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size);
};

extern const struct learner_ops learner_imle_ops;
extern const struct learner_ops learner_body_ops; /* IMLE until a body is found */
extern const struct learner_ops learner_null_ops;
extern const struct learner_ops learner_lwpr_ops;

/* Defaults of config.lwpr, and its part of the hash below. */
struct learner_lwpr_config learner_lwpr_default(int n_inputs);
uint64_t learner_lwpr_hash(uint64_t hash, const struct learner_config *config);

/* A row and the range that its number must be in. */
struct learner_range {
    const char *name;
    double value;
    double minimum;
    double maximum;
};

/* 0, or -1 and a line in err for the first that is out of range or NaN. */
int learner_check_ranges(const struct learner_range *ranges, size_t n, char *err, size_t err_size);

/* The implementation that a configuration asks for; NULL for a kind that is none. */
const struct learner_ops *learner_ops_of(const struct learner_config *config);

/* A hash (FNV-1a) of all that gives a saved state its meaning: every row but the capacity and those
 * that only shape predictions. */
uint64_t learner_config_hash(const struct learner_config *config);

/* FNV-1a over bytes, continued from `hash`; begin with LEARNER_HASH_START. */
#define LEARNER_HASH_START 14695981039346656037ULL
uint64_t learner_hash(uint64_t hash, const void *bytes, size_t n);

#ifdef __cplusplus
}
#endif
#endif
