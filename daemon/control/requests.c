#include "daemon/control/inputs.h"
#include "daemon/control/tick_private.h"

#include <string.h>

static bool may_start(const struct tick *tick)
{
    /* The tick after work is done still finds the state in which it was done. */
    return (tick->state == SUPERVISOR_IDLE || tick->state == SUPERVISOR_ACTIVE) &&
           !tick->behaviour.ops;
}

static int8_t start_behaviour(struct tick *tick, const reach_request_t *request,
                              struct control *control)
{
    if (!may_start(tick))
        return REACH_STATUS_T_REFUSED_STATE;
    memset(&tick->behaviour, 0, sizeof tick->behaviour);
    tick->behaviour.ops = behaviour_for_request(request->kind);
    tick->behaviour.request_seq = request->seq;
    tick->behaviour.learn = request->learn != 0;
    tick->behaviour.ops->start(&tick->behaviour, request, control);
    return REACH_STATUS_T_ACCEPTED;
}

static int8_t answer(struct tick *tick, const reach_request_t *request, struct control *control)
{
    if (!inputs_request_ok(tick->config, request))
        return REACH_STATUS_T_REFUSED_VALUE;
    switch (request->kind) {
    case REACH_REQUEST_T_STOP:
        tick->behaviour.ops = NULL;
        return REACH_STATUS_T_ACCEPTED;
    case REACH_REQUEST_T_RESET_FAULT:
        tick->reset_requested = true;
        return REACH_STATUS_T_ACCEPTED;
    case REACH_REQUEST_T_EMERGENCY:
        tick->emergency_requested = true;
        return REACH_STATUS_T_ACCEPTED;
    case REACH_REQUEST_T_SAVE:
        return model_store_begin_save(tick->store, request->count) ? REACH_STATUS_T_PENDING
                                                                   : REACH_STATUS_T_REFUSED_STATE;
    case REACH_REQUEST_T_LOAD:
        /* The model must not change under a behaviour that steers by it. */
        tick->loading = may_start(tick) && model_store_begin_load(tick->store, request->count);
        return tick->loading ? REACH_STATUS_T_PENDING : REACH_STATUS_T_REFUSED_STATE;
    default:
        return start_behaviour(tick, request, control);
    }
}

void tick_take_requests(struct tick *tick, const struct tick_inputs *inputs,
                        struct control *control)
{
    enum model_store_result stored = model_store_poll(tick->store, &tick->learner);

    if (stored != MODEL_STORE_NOTHING && tick->request_result == REACH_STATUS_T_PENDING)
        tick->request_result =
            stored == MODEL_STORE_DONE ? REACH_STATUS_T_ACCEPTED : REACH_STATUS_T_FAILED;
    if (stored == MODEL_STORE_DONE && tick->loading)
        context_init(&tick->context); /* its experts are others */
    if (stored != MODEL_STORE_NOTHING)
        tick->loading = false;
    tick->request_seq_now = 0;
    for (int i = 0; i < inputs->n_requests; i++) {
        const reach_request_t *request = &inputs->request[i];
        if (request->seq == tick->request_seq)
            continue;
        tick->request_seq = tick->request_seq_now = request->seq;
        tick->request_result = answer(tick, request, control);
        if (tick->request_result == REACH_STATUS_T_REFUSED_VALUE)
            tick->bad_inputs++;
    }
}
