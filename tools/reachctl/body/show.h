/* A found body for people and for other programs. */
#ifndef REACH_TOOLS_REACHCTL_BODY_SHOW_H
#define REACH_TOOLS_REACHCTL_BODY_SHOW_H

#include "learner/body/chain/body.h"

#include <stdio.h>

/* Axes, lengths, how sure each is, and what is not yet known. */
void body_show(const struct body *body, FILE *stream);

/* A URDF of its links and joints, with the range that each joint was seen to go through; the
 * lengths of a body that eyes found are in a unit of their own. */
void body_write_urdf(const struct body *body, FILE *stream);

/* Denavit's and Hartenberg's numbers (dh.h), a line a joint. */
void body_write_dh(const struct body *body, FILE *stream);

#endif
