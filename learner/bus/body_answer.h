/* What reach-finder answers, read from the bytes of a body_t: from the bus or from a log. */
#ifndef REACH_LEARNER_BUS_BODY_ANSWER_H
#define REACH_LEARNER_BUS_BODY_ANSWER_H

#include "learner/store/finder_port.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* An answer, and the request that it names. */
struct received_body {
    int64_t request_utime;
    struct body_answer answer;
};

/* Returns false for what is longer, shorter or of another type, and for an answer that cannot be
 * used. What a body in it holds is checked; whether it is the learner's, the learner says. */
bool body_answer_read(const void *data, size_t size, struct received_body *received);

#endif
