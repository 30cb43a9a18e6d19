/* Contexts: the situations (hand, a tool) that the robot has found itself in, counted, and which
 * one it is in now. Nobody tells; it follows from which experts the solution in use rests on.
 *
 * When the solution in use passes from one expert to another, the two belong to one context if its
 * value went on without a jump, and to two if it jumped: the same branch of the map has several
 * experts side by side, another tool is somewhere else. A context counts once it has been followed
 * for some time, so that one wrong tick is none. Not saved with the model: after a restart contexts
 * are counted from one again. Used by the loop thread alone. */
#ifndef REACH_DAEMON_CONTROL_SENSES_CONTEXT_H
#define REACH_DAEMON_CONTROL_SENSES_CONTEXT_H

#include "daemon/control/kinematics/estimate.h"

#include <stdint.h>

enum {
    CONTEXT_EXPERTS = 1024, /* most experts that are told apart, as many as a model may have */
    CONTEXT_SETTLE = 25,    /* ticks that another context is followed before it is believed */
};

struct context {
    int32_t count;   /* contexts met so far */
    int32_t current; /* the one in use, 1 .. count; 0 before the first */

    int16_t label[CONTEXT_EXPERTS]; /* context that an expert belongs to, 0 = not known */
    int principal;                  /* expert followed at the last tick, -1 = none */
    double value[MAX_OUTPUTS];      /* that solution's value then */
    int waiting;                    /* expert of a context not yet believed, -1 = none */
    int ticks;                      /* that it has been followed */
};

void context_init(struct context *context);

/* One tick: looks at the solution in use. */
void context_follow(struct context *context, const struct estimate *estimate);

#endif
