/* What a tick was given, in its trace, and back again: the two must never differ, or a log would
 * not replay. */
#ifndef REACH_DAEMON_CONTROL_TRACE_H
#define REACH_DAEMON_CONTROL_TRACE_H

#include "daemon/control/tick.h"

/* Fills what the trace says of the inputs; everything else in it becomes zero. */
void trace_inputs(const struct tick_inputs *inputs, reach_trace_t *trace);

/* Whether these inputs leave anything behind in the tick: periods in which nobody told it anything
 * do not. */
bool trace_inputs_matter(const struct tick_inputs *inputs);

/* The inputs but for the messages: their numbers are left to the caller, who has to find them. */
void trace_to_inputs(const reach_trace_t *trace, struct tick_inputs *inputs);

#endif
