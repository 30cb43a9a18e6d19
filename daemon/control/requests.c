#include "daemon/control/inputs.h"
#include "daemon/control/tick_private.h"

#include <string.h>

static bool may_start(const struct tick *tick)
{
    /* The tick after work is done still finds the state in which it was done. */
    return (tick->state == SUPERVISOR_IDLE || tick->state == SUPERVISOR_ACTIVE) &&
           !tick->behaviour.ops;
}

static int8_t start_behaviour(struct tick *tick, const struct behaviour_ops *ops,
                              const reach_request_t *request, const struct senses *senses,
                              struct wants *wants)
{
    struct behaviour *behaviour = &tick->behaviour;

    if (!ops->accepts(tick->config, request))
        return REACH_STATUS_T_REFUSED_VALUE;
    if (!may_start(tick))
        return REACH_STATUS_T_REFUSED_STATE;
    behaviour->ops = ops;
    behaviour->request_seq = request->seq;
    behaviour->learn = request->learn != 0;
    behaviour->progress = (struct progress){0};
    memset(behaviour->state, 0, ops->state_size);
    ops->start(behaviour, request, senses, wants);
    return REACH_STATUS_T_ACCEPTED;
}

static bool begin_save(struct tick *tick, int number)
{
    return tick->model.ops->begin_save(tick->model.context, number);
}

/* The model must not change under a behaviour that steers by it. */
static bool begin_load(struct tick *tick, int number)
{
    return may_start(tick) && tick->model.ops->begin_load(tick->model.context, number);
}

static bool tell_body(struct tick *tick)
{
    if (!learner_body(tick->learner))
        return false;
    tick->model.ops->tell_body(tick->model.context);
    return true;
}

static bool begin_forgetting(struct tick *tick)
{
    if (!may_start(tick) || !learner_body(tick->learner))
        return false;
    tick->model.ops->begin_forgetting(tick->model.context);
    return true;
}

/* What is asked of the daemon itself. */
static int8_t serve(struct tick *tick, const reach_request_t *request)
{
    if (!inputs_request_ok(request))
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
        return begin_save(tick, request->count) ? REACH_STATUS_T_PENDING
                                                : REACH_STATUS_T_REFUSED_STATE;
    case REACH_REQUEST_T_LOAD:
        tick->loading = begin_load(tick, request->count);
        return tick->loading ? REACH_STATUS_T_PENDING : REACH_STATUS_T_REFUSED_STATE;
    case REACH_REQUEST_T_TELL_BODY:
        return tell_body(tick) ? REACH_STATUS_T_ACCEPTED : REACH_STATUS_T_REFUSED_STATE;
    case REACH_REQUEST_T_FORGET_BODY:
        return begin_forgetting(tick) ? REACH_STATUS_T_PENDING : REACH_STATUS_T_REFUSED_STATE;
    default:
        return REACH_STATUS_T_REFUSED_VALUE;
    }
}

/* Returns a request_result of status_t. */
static int8_t answer_request(struct tick *tick, const reach_request_t *request,
                             const struct senses *senses, struct wants *wants)
{
    const struct behaviour_ops *ops = behaviour_find(tick->behaviours, request->kind);

    return ops ? start_behaviour(tick, ops, request, senses, wants) : serve(tick, request);
}

/* A save or a load that is over answers the request that waits for it. */
static void poll_model(struct tick *tick)
{
    bool had_body = learner_body(tick->learner) != NULL;
    enum model_result result = tick->model.ops->poll(tick->model.context, &tick->learner);

    if (had_body != (learner_body(tick->learner) != NULL))
        context_init(&tick->context); /* its experts are others; a later body keeps them */
    if (result == MODEL_NOTHING)
        return;
    if (tick->request_result == REACH_STATUS_T_PENDING)
        tick->request_result =
            result == MODEL_DONE ? REACH_STATUS_T_ACCEPTED : REACH_STATUS_T_FAILED;
    if (result == MODEL_DONE && tick->loading)
        context_init(&tick->context); /* its experts are others */
    tick->loading = false;
}

void tick_take_requests(struct tick *tick, const struct tick_inputs *inputs,
                        const struct senses *senses, struct wants *wants)
{
    poll_model(tick);
    tick->request_seq_now = 0;
    for (int i = 0; i < inputs->n_requests; i++) {
        const reach_request_t *request = &inputs->request[i];
        if (request->seq == tick->request_seq)
            continue;
        tick->request_seq = tick->request_seq_now = request->seq;
        tick->request_result = answer_request(tick, request, senses, wants);
        if (tick->request_result == REACH_STATUS_T_REFUSED_VALUE)
            tick->bad_inputs++;
    }
}
