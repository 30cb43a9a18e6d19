#include "daemon/control/trace.h"

#include <string.h>

_Static_assert(sizeof((reach_trace_t *)0)->observation / sizeof(int64_t) == TICK_MAX_OBSERVATIONS &&
                   sizeof((reach_trace_t *)0)->request / sizeof(int64_t) == TICK_MAX_REQUESTS,
               "trace_t has room for all that a tick takes");

void trace_inputs(const struct tick_inputs *inputs, reach_trace_t *trace)
{
    memset(trace, 0, sizeof *trace);
    trace->has_state = inputs->has_state;
    if (inputs->has_state) {
        trace->given_state = inputs->state.seq;
        trace->state_checksum = (int32_t)inputs->state_checksum;
    }
    trace->state_age = inputs->state_age;
    trace->n_observations = inputs->n_observations;
    for (int i = 0; i < inputs->n_observations; i++) {
        trace->observation[i] = inputs->observation[i].seq;
        trace->observation_checksum[i] = (int32_t)inputs->observation[i].checksum;
    }
    trace->n_requests = inputs->n_requests;
    for (int i = 0; i < inputs->n_requests; i++) {
        trace->request[i] = inputs->request[i].seq;
        trace->request_checksum[i] = (int32_t)inputs->request_checksum[i];
    }
    trace->slipped = inputs->slipped;
    trace->braked = inputs->braked;
    trace->crossed = inputs->crossed;
    trace->overrunning = inputs->overrunning;
    trace->emergency = inputs->emergency;
    trace->robot_rests = inputs->robot_rests;
}

bool trace_inputs_matter(const struct tick_inputs *inputs)
{
    return inputs->has_state || inputs->n_observations > 0 || inputs->n_requests > 0 ||
           inputs->config || inputs->overrunning || inputs->emergency || inputs->braked > 0 ||
           inputs->crossed > 0 || inputs->robot_rests;
}

void trace_to_inputs(const reach_trace_t *trace, struct tick_inputs *inputs)
{
    memset(inputs, 0, sizeof *inputs);
    inputs->state_age = trace->state_age;
    inputs->slipped = trace->slipped;
    inputs->braked = trace->braked;
    inputs->crossed = trace->crossed;
    inputs->overrunning = trace->overrunning != 0;
    inputs->emergency = trace->emergency != 0;
    inputs->robot_rests = trace->robot_rests != 0;
}
