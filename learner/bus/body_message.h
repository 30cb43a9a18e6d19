/* A body in body_t, both ways. */
#ifndef REACH_LEARNER_BUS_BODY_MESSAGE_H
#define REACH_LEARNER_BUS_BODY_MESSAGE_H

#include "learner/body/chain/body.h"

#include <reach_body_t.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fills numbers and checksum; NULL: zeros. */
void body_message_put(const struct body *body, reach_body_t *message);

/* Returns false when they are not as they were sent, or no body that can be used. */
bool body_message_take(const reach_body_t *message, struct body *body);

#ifdef __cplusplus
}
#endif
#endif
