/* The model store of learner/, as the keeper of the control step's model: the one place that knows
 * both. */
#ifndef REACH_DAEMON_MODEL_OF_STORE_H
#define REACH_DAEMON_MODEL_OF_STORE_H

#include "daemon/config/config.h"
#include "daemon/control/model_port.h"
#include "learner/store/store.h"

/* The model.* options, for the store, and who finds bodies for it (NULL: nobody)
 * and what searches begin with (NULL: nothing). Points into `config`. */
struct model_store_settings model_of_store_settings(const struct config *config,
                                                    const struct finder_port *finder,
                                                    const struct body *start);

/* Whether the folder of models is one. Returns 0, or -1 with one line in `error`. */
int model_of_store_check(const struct config *config, char *error, size_t error_size);

/* `store` stays the caller's. */
struct model_port model_of_store(struct model_store *store);

#endif
