/* Numbers that a saved state is made of. For state.c and state_context.c alone. */
#ifndef REACH_LEARNER_BODY_CONTEXTS_STATE_PRIVATE_H
#define REACH_LEARNER_BODY_CONTEXTS_STATE_PRIVATE_H

#include "learner/body/contexts/contexts.h"

struct writer {
    unsigned char *to;
};

/* Reads twice: first only to see whether everything fits, then into its place. */
struct reader {
    const unsigned char *from;
    bool fits;
    bool into_place;
};

/* Counts stay whole numbers up to here; no robot offers as many samples. */
extern const double state_most_counted;

void state_write(struct writer *writer, size_t n, const double *numbers);

/* Numbers to look at; into their place, once all fits. */
void state_read_head(struct reader *reader, size_t n, double *numbers);
void state_read(struct reader *reader, size_t n, double *numbers);

void state_demand(struct reader *reader, bool right);
int state_whole(struct reader *reader, double number, int least, int most);

/* Samples that are kept take three numbers more than kept_numbers(). */
void state_write_kept(struct writer *writer, const struct kept *kept);
void state_read_kept(struct reader *reader, struct kept *kept);

/* A context with all that is its own. state_read_context() returns whether it is confirmed. */
size_t state_context_numbers(const struct design *design);
void state_write_context(struct writer *writer, const struct design *design,
                         const struct context *context);
bool state_read_context(struct reader *reader, const struct design *design, bool used,
                        struct context *context);

#endif
