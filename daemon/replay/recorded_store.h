/* The keeper of a replay's model: says what the store said in the recorded run, tick by tick, and
 * has the models that were loaded from files. It writes nothing. */
#ifndef REACH_DAEMON_REPLAY_RECORDED_STORE_H
#define REACH_DAEMON_REPLAY_RECORDED_STORE_H

#include "common/base/arena.h"
#include "daemon/control/model_port.h"
#include "learner/body/chain/body.h"
#include "learner/store/model_file.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct recorded_store {
    const char *const *paths; /* of model files, the caller's */
    int n_paths;

    /* The rest is recorded_store.c's. */
    struct arena *arena;     /* of what follows, once a model is needed */
    struct learner *learner; /* that models are read into */
    struct model_bytes model;
    uint64_t hash; /* of what the control step's learner was given whole */
    bool take;     /* `learner` changes places with the control step's at the next poll */
    struct model_moment moment;
    bool ready; /* a save or load can begin */
};

/* A run begins with the model of this hash, 0 = with none: reads it into `learner`, which knows
 * nothing yet. `config` is the learner's. Returns 0, or -1 with one line in `error`. */
int recorded_store_open(struct recorded_store *store, const struct learner_config *config,
                        uint64_t hash, struct learner *learner, char *error, size_t error_size);

/* What the store said in the tick ahead. The model that it names, when it is another one than
 * before, is read and changes places with the control step's. Returns as above. */
int recorded_store_follow(struct recorded_store *store, const struct learner_config *config,
                          const struct model_moment *moment, char *error, size_t error_size);

/* The control step's learner was given this body in the tick ahead: one that is equal and stands on
 * it will change places with it. Returns as above. */
int recorded_store_give(struct recorded_store *store, const struct learner_config *config,
                        const struct learner *learner, const struct body *body, char *error,
                        size_t error_size);

/* The run is over: frees what it had; the next may be opened. */
void recorded_store_close(struct recorded_store *store);

struct model_port recorded_store_port(struct recorded_store *store);

#endif
