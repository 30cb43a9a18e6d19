/* Lists of visual targets for a request. */
#ifndef REACH_TOOLS_REACHCTL_TARGET_LIST_H
#define REACH_TOOLS_REACHCTL_TARGET_LIST_H

#include <reach_request_t.h>
#include <stddef.h>

/* The 16 targets of the paper's sections 7.2 and 7.3: each of the 8 ends at 50 px, every one
 * followed by the centre; disparity 0. */
void targets_star(reach_request_t *request);

/* Reads lines "u v disparity" (px); '#' starts a comment.
 *   returns 0, or -1 with "file:line: reason" in `error` */
int targets_read(const char *path, reach_request_t *request, char *error, size_t error_size);

#endif
