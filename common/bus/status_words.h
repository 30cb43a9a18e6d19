/* The words for what a status_t holds as numbers. */
#ifndef REACH_COMMON_BUS_STATUS_WORDS_H
#define REACH_COMMON_BUS_STATUS_WORDS_H

#include <reach_status_t.h>
#include <stddef.h>

/* Each takes the field of that name; "unknown" for a number that has no word. */
const char *status_state_word(int state);
const char *status_fault_word(int fault);
const char *status_behaviour_word(int behaviour);
const char *status_phase_word(int phase);
const char *status_result_word(int request_result);
const char *status_body_word(int body);

/* The fault with the joint that it is of, such as "a joint jumped: joint 3 by 0.9 rad". */
void status_fault_text(const reach_status_t *status, char *text, size_t size);

#endif
