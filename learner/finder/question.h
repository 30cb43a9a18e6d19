/* A request for a search as it comes from the bus: nothing in it is trusted. */
#ifndef REACH_LEARNER_FINDER_QUESTION_H
#define REACH_LEARNER_FINDER_QUESTION_H

#include "learner/body/search/search.h"

#include <reach_body_request_t.h>
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct question {
    reach_body_request_t request; /* what `settings` and `contexts` point into */
    struct finder_settings settings;
    struct body start;
    int n_contexts;
    struct learner_samples contexts[LEARNER_MAX_SOLUTIONS];
};

/* Reads the bytes of a body_request_t, and checks every number. Returns a question, to be freed
 * with question_free(). Otherwise NULL, with one line in `why` and in `name` the utime and seq that
 * it has; both are 0 when it is no body_request_t at all. */
struct question_name {
    int64_t utime, seq;
};
struct question *question_read(const void *data, size_t size, struct question_name *name, char *why,
                               size_t why_size);

/* NULL is allowed. */
void question_free(struct question *question);

#ifdef __cplusplus
}
#endif
#endif
