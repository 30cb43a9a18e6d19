/* What a status says of messages that reachd refused, for people. */
#ifndef REACH_COMMON_BUS_REFUSALS_TEXT_H
#define REACH_COMMON_BUS_REFUSALS_TEXT_H

#include <reach_status_t.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes "12 ROBOT_STATE (a value is out of range), 1 REACH_REQUEST (malformed)": what was refused
 * from the status `before` (NULL: the start) to `now`; with what was wrong in the newest robot
 * state, where it is one of them. "" when nothing was. */
void refusals_text(const reach_status_t *now, const reach_status_t *before, char *text,
                   size_t size);

#ifdef __cplusplus
}
#endif

#endif
