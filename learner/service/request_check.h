/* What a request must be like, whoever sends it and whatever is known. */
#ifndef REACH_LEARNER_SERVICE_REQUEST_CHECK_H
#define REACH_LEARNER_SERVICE_REQUEST_CHECK_H

#include <reach_learner_request_t.h>
#include <stdbool.h>
#include <stdint.h>

/* For a learner of these dimensions, which keeps models on disk or not. Returns a status of
 * learner_reply_t: DONE, or why it is refused. */
int8_t request_check(const reach_learner_request_t *request, int n_inputs, int n_outputs,
                     bool keeps);

#endif
