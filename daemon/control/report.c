#include "daemon/control/tick_private.h"

#include "learner/body/chain/body.h"

#include <math.h>
#include <string.h>

/* The pair belongs to the past; eq. 14 brings its output to the present joints. */
void tick_anchor(struct tick *tick, const struct pair *pair)
{
    struct estimate *estimate = &tick->estimate;
    const double *jacobian = estimate_jacobian(estimate);
    double x[MAX_OUTPUTS] = {0};

    for (int row = 0; row < estimate->n_outputs; row++) {
        x[row] = pair->x[row];
        for (int i = 0; jacobian && i < estimate->n_inputs; i++)
            x[row] += jacobian[row * estimate->n_inputs + i] * (tick->q[i] - pair->q[i]);
    }
    estimate_anchor(estimate, x);
}

/* A pair of this very instant needs no prediction of its own. */
static const struct learner_prediction *predict_at(struct tick *tick, const double *q)
{
    size_t size = sizeof(double) * (size_t)tick->estimate.n_inputs;

    if (tick->state_seq_now && memcmp(q, tick->q, size) == 0)
        return &tick->estimate.prediction;
    learner_predict(tick->learner, q, &tick->pair_prediction);
    return &tick->pair_prediction;
}

/* Nothing of joints that may not be where they seem to be, nor of eyes that repeat themselves or
 * show what cannot be. */
static bool is_learned(struct tick *tick, const struct pair *pair)
{
    if (!tick->behaviour.learn || tick->following.doubts)
        return false;
    if (health_look(&tick->health, pair->q, pair->x) &&
        witness_believes(&tick->witness, tick->time))
        return true;
    tick->frozen++;
    return false;
}

void tick_take_pair(struct tick *tick, const struct pair *pair, struct tick_outputs *outputs)
{
    struct estimate *estimate = &tick->estimate;
    const struct learner_prediction *prediction = predict_at(tick, pair->q);
    reach_sample_t *sample = &outputs->sample;
    bool learns = is_learned(tick, pair);

    memset(sample, 0, sizeof *sample);
    sample->utime = pair->utime;
    sample->seq = ++tick->sample_seq;
    sample->request_seq = tick->behaviour.request_seq;
    sample->learned = learns;
    sample->n_inputs = estimate->n_inputs;
    sample->n_outputs = estimate->n_outputs;
    memcpy(sample->q, pair->q, sizeof sample->q);
    memcpy(sample->x, pair->x, sizeof sample->x);
    sample->solutions = prediction->n_solutions;
    sample->solution = estimate_closest(estimate, prediction, estimate->x_estimated);
    for (int k = 0; k < prediction->n_solutions; k++)
        memcpy(sample->values[k], prediction->solution[k].value, sizeof sample->values[k]);
    if (sample->solution >= 0)
        memcpy(sample->x_predicted, prediction->solution[sample->solution].value,
               sizeof sample->x_predicted);
    outputs->has_sample = true;

    if (learns)
        sample_queue_add(&tick->queue, pair->q, estimate->n_inputs, pair->x, estimate->n_outputs);
    tick_anchor(tick, pair);
}

static double error_norm(const struct tick *tick)
{
    double sum = 0;

    for (int axis = 0; tick->has_target && axis < SPACE_DIMENSIONS; axis++) {
        double error = tick->target[axis] - tick->sight.carried[axis];
        sum += error * error;
    }
    return sqrt(sum);
}

static void report_behaviour(const struct tick *tick, reach_status_t *status)
{
    const struct behaviour *behaviour = &tick->behaviour;

    status->behaviour = behaviour->ops ? behaviour->ops->code : REACH_STATUS_T_NONE;
    status->phase = behaviour->ops ? behaviour->progress.phase : REACH_STATUS_T_DONE;
    status->progress = behaviour->progress.done;
    status->progress_total = behaviour->progress.total;
    status->skipped = behaviour->progress.skipped;
}

/* Samples that were handed to the model in its life, those that it dropped among them. */
static int64_t samples_of(const struct learner_statistics *counts)
{
    return (int64_t)(counts->samples + counts->outliers + counts->full + counts->refused);
}

static void report_change(const struct learner *learner, reach_status_t *status)
{
    const struct learner_body_change change = learner_get_body_change(learner);
    int n_inputs = learner_body(learner)->chain.n;

    status->body_changes = (int64_t)change.changes;
    status->body_changed = change.cause >= n_inputs ? -1 : change.cause + 1;
    memcpy(status->body_changed_by, change.by, sizeof status->body_changed_by);
    status->body_slip = change.slip;
}

static void report_body(const struct tick *tick, const struct model_report *model,
                        reach_status_t *status)
{
    const struct body *body = learner_body(tick->learner);

    status->body = (int8_t)(body ? MODEL_FOUND : model->search);
    status->body_searches = model->searches;
    if (!body)
        return;
    status->body_samples = body->samples;
    status->body_error = body->error;
    status->body_doubt = body->doubt;
    memcpy(status->body_not_rigid, model->not_rigid, sizeof status->body_not_rigid);
    report_change(tick->learner, status);
}

static void report_model(const struct tick *tick, reach_status_t *status)
{
    const struct estimate *estimate = &tick->estimate;
    const double *value = estimate_value(estimate);
    const struct learner_statistics statistics = learner_get_statistics(tick->learner);
    struct model_report model = tick->model.ops->report(tick->model.context);

    status->samples = tick->queue.learned;
    status->model_samples = samples_of(&statistics);
    status->samples_stored = model.stored;
    status->storing = model.storing;
    status->store_waits = model.waits;
    report_body(tick, &model, status);
    status->experts = statistics.experts;
    status->solutions = estimate->prediction.n_solutions;
    status->solution = estimate->solution;
    status->contexts = tick->context.count;
    status->context = tick->context.current;
    status->n_outputs = estimate->n_outputs;
    if (value)
        memcpy(status->x_predicted, value, sizeof status->x_predicted);
    memcpy(status->x_estimated, estimate->x_estimated, sizeof status->x_estimated);
    status->queue = tick->queue.count;
    status->dropped_samples = tick->queue.dropped;
}

/* A joint that stands still is no trouble: the robot moves one after the other by itself. */
static void report_health(const struct tick *tick, reach_status_t *status)
{
    const struct learner_statistics statistics = learner_get_statistics(tick->learner);
    const struct health *health = &tick->health;

    status->frozen_samples = tick->frozen;
    status->troubles = (int32_t)((health_judge(health, &statistics) & ~(1u << HEALTH_CONSTANT)) |
                                 witness_tells(&tick->witness, tick->time) << HEALTH_TROUBLES);
    if (!(status->troubles & REACH_STATUS_T_FAR))
        return;
    int joint = health_farthest(health);
    status->trouble_joint = joint + 1;
    status->trouble_value = health->input[joint].farthest;
    status->trouble_scales = health_scales(health, joint, status->trouble_value);
}

static void report_status(const struct tick *tick, int64_t now, reach_status_t *status)
{
    memset(status, 0, sizeof *status);
    status->utime = now;
    status->seq = tick->seq;
    status->state_seq = tick->state_seq;
    status->state = (int8_t)tick->state;
    status->fault = tick->fault;
    status->fault_joint = tick->fault_joint;
    status->fault_value = tick->fault_joint ? tick->fault_value : 0;
    status->request_seq = tick->request_seq;
    status->request_result = tick->request_result;
    status->model_request_seq = tick->model_request_seq;
    status->model_result = tick->model_result;
    status->marker_seen = sight_seen(&tick->sight, now);
    status->fixated = sight_fixated(&tick->sight);
    status->space = (int8_t)tick->config->space.kind;
    status->error = error_norm(tick);
    refusals_into_status(tick->refusals.count, status);
    refusals_name_state(&tick->refusals, status);
    status->staleness = tick->state_known ? tick->state_age : -1;
    status->gated = tick->safety.changed;
    report_behaviour(tick, status);
    report_model(tick, status);
    report_health(tick, status);
}

_Static_assert(REACH_STATUS_T_MANY_FULL == 1 << HEALTH_FULL &&
                   REACH_STATUS_T_MANY_OUTLIERS == 1 << HEALTH_OUTLIERS &&
                   REACH_STATUS_T_FAR == 1 << HEALTH_FAR &&
                   REACH_STATUS_T_STILL == 1 << HEALTH_FROZEN &&
                   REACH_STATUS_T_EXPERTS == 1 << HEALTH_EXPERTS &&
                   REACH_STATUS_T_JUMPS == 1 << (HEALTH_TROUBLES + WITNESS_JUMPS) &&
                   REACH_STATUS_T_RESTLESS == 1 << (HEALTH_TROUBLES + WITNESS_RESTLESS) &&
                   REACH_STATUS_T_LATE == 1 << (HEALTH_TROUBLES + WITNESS_LATE) &&
                   REACH_STATUS_T_ONE_EYE == 1 << (HEALTH_TROUBLES + WITNESS_ONE_EYE) &&
                   REACH_STATUS_T_UNMOVED == 1 << (HEALTH_TROUBLES + WITNESS_STILL),
               "status_t.troubles has a bit for each enum health_trouble and witness_doubt");

static void report_trace(const struct tick *tick, int64_t now, const struct tick_outputs *outputs,
                         reach_trace_t *trace)
{
    struct model_moment moment = tick->model.ops->moment(tick->model.context);

    trace->utime = now;
    trace->seq = tick->seq;
    trace->store_result = (int8_t)moment.result;
    trace->store_ready = moment.ready;
    trace->model = (int64_t)moment.model;
    trace->body = moment.body;
    trace->body_checksum = (int32_t)moment.body_checksum;
    trace->config = (int32_t)tick->config->checksum;
    trace->state_seq = tick->state_seq_now;
    trace->marker_seq = tick->marker_seq_now;
    trace->request_seq = tick->request_seq_now;
    trace->learned = tick->learned_now;
    trace->n_joints = outputs->command.n_joints;
    memcpy(trace->velocity, outputs->command.velocity, sizeof trace->velocity);
    trace->solutions = tick->estimate.prediction.n_solutions;
    trace->solution = tick->estimate.solution;
    trace->n_outputs = tick->estimate.n_outputs;
    memcpy(trace->x_seen, tick->sight.carried, sizeof trace->x_seen);
    memcpy(trace->x_target, tick->target, sizeof trace->x_target);
    memcpy(trace->x_estimated, tick->estimate.x_estimated, sizeof trace->x_estimated);
}

void tick_report(struct tick *tick, int64_t now, struct tick_outputs *outputs)
{
    report_status(tick, now, &outputs->status);
    report_trace(tick, now, outputs, &outputs->trace);
}
