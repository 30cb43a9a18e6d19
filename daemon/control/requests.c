#include "daemon/control/inputs.h"
#include "daemon/control/tick_private.h"

#include <string.h>

/* A save, load or forgetting is being worked on. */
static bool model_works(const struct tick *tick)
{
    return tick->model_result == REACH_STATUS_T_PENDING;
}

/* Neither may the model be exchanged under a behaviour that steers by it, nor a behaviour begin
 * while it is about to be. */
static bool may_start(const struct tick *tick)
{
    /* The tick after work is done still finds the state in which it was done. */
    return (tick->state == SUPERVISOR_IDLE || tick->state == SUPERVISOR_ACTIVE) &&
           !tick->behaviour.ops && !(model_works(tick) && tick->model_kind != REACH_REQUEST_T_SAVE);
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

static bool tell_body(struct tick *tick)
{
    if (!learner_body(tick->learner))
        return false;
    tick->model.ops->tell_body(tick->model.context);
    return true;
}

/* Whether that could begin. */
static bool begin_model_work(struct tick *tick, const struct model_port *model,
                             const reach_request_t *request)
{
    switch (request->kind) {
    case REACH_REQUEST_T_SAVE:
        return model->ops->begin_save(model->context, request->count);
    case REACH_REQUEST_T_LOAD:
        return may_start(tick) && model->ops->begin_load(model->context, request->count);
    default:
        if (!may_start(tick) || !learner_body(tick->learner))
            return false;
        model->ops->begin_forgetting(model->context);
        return true;
    }
}

/* One after the other: what came of it is told by its own number, whatever else is asked. */
static int8_t work_on_model(struct tick *tick, const reach_request_t *request)
{
    if (model_works(tick) || !begin_model_work(tick, &tick->model, request))
        return REACH_STATUS_T_REFUSED_STATE;
    tick->model_request_seq = request->seq;
    tick->model_kind = request->kind;
    tick->model_result = REACH_STATUS_T_PENDING;
    return REACH_STATUS_T_PENDING;
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
        plausible_forget(&tick->plausible);
        following_init(&tick->following, tick->config);
        return REACH_STATUS_T_ACCEPTED;
    case REACH_REQUEST_T_EMERGENCY:
        tick->emergency_requested = true;
        return REACH_STATUS_T_ACCEPTED;
    case REACH_REQUEST_T_SAVE:
    case REACH_REQUEST_T_LOAD:
    case REACH_REQUEST_T_FORGET_BODY:
        return work_on_model(tick, request);
    case REACH_REQUEST_T_TELL_BODY:
        return tell_body(tick) ? REACH_STATUS_T_ACCEPTED : REACH_STATUS_T_REFUSED_STATE;
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

/* A save, load or forgetting that is over answers the request that waits for it. */
static void poll_model(struct tick *tick)
{
    enum model_result result = tick->model.ops->poll(tick->model.context, &tick->learner);

    bool has_body = learner_body(tick->learner) != NULL;
    if (has_body != tick->had_body)
        context_init(&tick->context); /* its experts are others; a later body keeps them */
    tick->had_body = has_body;
    if (result == MODEL_NOTHING || !model_works(tick))
        return;
    if (result == MODEL_DONE && tick->model_kind == REACH_REQUEST_T_LOAD)
        context_init(&tick->context); /* its experts are others */
    tick->model_result = result == MODEL_DONE ? REACH_STATUS_T_ACCEPTED : REACH_STATUS_T_FAILED;
    if (tick->request_seq == tick->model_request_seq)
        tick->request_result = tick->model_result;
}

void tick_take_requests(struct tick *tick, const struct tick_inputs *inputs,
                        const struct senses *senses, struct wants *wants)
{
    poll_model(tick);
    tick->request_seq_now = 0;
    for (int i = 0; i < inputs->n_requests; i++) {
        const reach_request_t *request = &inputs->request[i];
        if (request->seq == tick->request_seq ||
            (request->seq == tick->model_request_seq && request->seq != 0))
            continue;
        tick->request_seq = tick->request_seq_now = request->seq;
        tick->request_result = answer_request(tick, request, senses, wants);
        if (tick->request_result == REACH_STATUS_T_REFUSED_VALUE)
            refusals_add(&tick->refusals, REACH_STATUS_T_CHANNEL_REQUEST, REACH_STATUS_T_VALUE);
    }
}
