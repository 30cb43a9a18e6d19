/* Where requests are answered: what goes out depends on what came in so far, on the model, and on
 * the time that is handed in; nothing here waits, sends, or reads a clock. Not for several threads.
 *
 * A sample that goes to disk is answered only when it is safe there: its answer waits, oldest
 * first, and predictions overtake it. */
#ifndef REACH_LEARNER_SERVICE_DESK_H
#define REACH_LEARNER_SERVICE_DESK_H

#include "common/base/arena.h"
#include "learner/health/health.h"
#include "learner/learner.h"
#include "learner/store/store.h"

#include <reach_learner_prediction_t.h>
#include <reach_learner_reply_t.h>
#include <reach_learner_request_t.h>
#include <stdbool.h>
#include <stdint.h>

#define DESK_WAITING 1024 /* answers that may wait for the disk; a power of two */

struct desk;

size_t desk_memory(void);

/* Of a learner that is as the store says, when `keeps`: the store has a directory. All stay the
 * caller's. NULL when the arena is full. */
struct desk *desk_create(const struct learner_config *config, struct learner *learner,
                         struct model_store *store, bool keeps, struct arena *arena);

/* From now on samples whose outputs stand still while inputs move are learned, too. */
void desk_learn_frozen(struct desk *desk);

/* What is wrong with the samples, bit 1 << enum health_trouble each, and one line about one. */
unsigned desk_troubles(const struct desk *desk);
void desk_tell(const struct desk *desk, enum health_trouble trouble, char *text, size_t size);

enum desk_answer { DESK_SILENT, DESK_REPLY, DESK_PREDICTION };

/* One of the two is filled, as the answer says. */
struct desk_output {
    reach_learner_reply_t reply;
    reach_learner_prediction_t prediction;
};

/* Does what a request asks that has `waited` here for so long, us, by a clock that nobody sets; its
 * sender gave it the time from its utime to its deadline. `now` is that of stamps, us since the
 * epoch. DESK_SILENT: the answer comes later, out of desk_due. */
enum desk_answer desk_take(struct desk *desk, const reach_learner_request_t *request,
                           int64_t waited, int64_t now, struct desk_output *output);

/* The next answer that waited and need not any longer. Returns false when there is none. To be
 * called often: a body that was found becomes the learner's in here. */
bool desk_due(struct desk *desk, int64_t now, reach_learner_reply_t *reply);

/* What was lost before it came here, since start, for the replies. */
void desk_note_losses(struct desk *desk, int64_t dropped, int64_t malformed);

/* How the service is; without an addressee. */
void desk_describe(const struct desk *desk, reach_learner_reply_t *reply);

#endif
