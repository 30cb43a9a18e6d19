#include "learner/body/body_learner.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/base/hash.h"
#include "learner/body/chain/order.h"
#include "learner/body/contexts/follow.h"

struct learner_config body_meanwhile_config(const struct learner_config *config)
{
    struct learner_config meanwhile = *config;

    meanwhile.features = LEARNER_POLYNOMIAL;
    return meanwhile;
}

static int check(const struct learner_config *config, char *err, size_t err_size)
{
    struct learner_config meanwhile = body_meanwhile_config(config);

    if (config->n_outputs != BODY_OUTPUTS) {
        snprintf(err, err_size, "experts: body wants %d outputs, a place; here are %d",
                 BODY_OUTPUTS, config->n_outputs);
        return -1;
    }
    if (!order_is_whole(config)) {
        snprintf(err, err_size, "body.order does not name each input once");
        return -1;
    }
    return learner_imle_ops.check(&meanwhile, err, err_size);
}

/* Of the saved state: one of another format is refused as one of other parameters. */
static const double format = 2;

static uint64_t hash_meanwhile(const struct learner_config *config, uint64_t hash)
{
    double numbers[] = {(double)config->body.space, config->body.degrees, format};

    hash = learner_hash(learner_imle_ops.hash(config, hash), numbers, sizeof numbers);
    return learner_hash(hash, config->body.order,
                        (size_t)config->n_inputs * sizeof *config->body.order);
}

static size_t memory(const struct learner_config *config)
{
    struct learner_config meanwhile = body_meanwhile_config(config);
    size_t waiting = kept_numbers(BODY_WAITING, config->n_inputs, BODY_OUTPUTS) * sizeof(double);

    return arena_footprint(sizeof(struct body_learner)) + arena_footprint(waiting) +
           contexts_memory(config->n_inputs) + learner_imle_ops.memory(&meanwhile);
}

static void *create(const struct learner_config *config, struct arena *arena)
{
    struct learner_config meanwhile = body_meanwhile_config(config);
    size_t waiting = kept_numbers(BODY_WAITING, config->n_inputs, BODY_OUTPUTS) * sizeof(double);
    struct body_learner *self = arena_alloc(arena, sizeof *self);
    double *room = arena_alloc(arena, waiting);

    if (!self || !room)
        return NULL;
    self->config = *config;
    kept_place(&self->waiting, BODY_WAITING, config->n_inputs, BODY_OUTPUTS, room);
    self->contexts = contexts_create(&self->body, config->n_inputs, config->capacity,
                                     kernels_of(config->kernels), arena);
    self->meanwhile = learner_imle_ops.create(&meanwhile, arena);
    return self->contexts && self->meanwhile ? self : NULL;
}

static enum learner_update_result update(void *self, const double *z, const double *x)
{
    struct body_learner *learner = self;
    double joints[LEARNER_MAX_INPUTS];

    order_to_chain(&learner->config, z, joints);
    if (learner->found && body_try(learner, z, x))
        return LEARNER_UPDATED;
    learner->contexts->firm = !learner->doubtful;
    if (learner->found)
        return contexts_learn(learner->contexts, joints, x);
    kept_add(&learner->waiting, joints, x);
    return imle_learn(learner->meanwhile, z, x);
}

/* Among the strongest `most`, the strongest first. */
static void insert(struct learner_prediction *prediction, int most,
                   const struct learner_solution *solution)
{
    int at = prediction->n_solutions;

    if (at < most)
        prediction->n_solutions++;
    else if (prediction->solution[--at].weight >= solution->weight)
        return;
    for (; at > 0 && prediction->solution[at - 1].weight < solution->weight; at--)
        prediction->solution[at] = prediction->solution[at - 1];
    prediction->solution[at] = *solution;
}

/* Weights of those that have answered are shares. */
static void share(struct learner_prediction *prediction)
{
    double all = 0.0;

    for (int s = 0; s < prediction->n_solutions; s++)
        all += prediction->solution[s].weight;
    for (int s = 0; s < prediction->n_solutions; s++) {
        double *weight = &prediction->solution[s].weight;
        *weight = all > 0.0 ? *weight / all : 1.0 / prediction->n_solutions;
    }
}

static int predict(void *self, const double *z, struct learner_prediction *prediction)
{
    struct body_learner *learner = self;
    struct contexts *contexts = learner->contexts;
    struct learner_solution solution = {0}; /* rows beyond ours are sent, too */
    double joints[LEARNER_MAX_INPUTS];
    struct chain_pose pose;

    if (!learner->found)
        return imle_predict(learner->meanwhile, z, prediction);
    order_to_chain(&learner->config, z, joints);
    chain_at(&learner->body.chain, joints, &pose);
    design_rows(&contexts->design, &learner->body, &pose, contexts->rows);
    for (int j = 0; j < contexts->n; j++) {
        if (!contexts_answer(contexts, j, joints, &pose, &solution))
            continue;
        order_to_inputs(&learner->config, BODY_OUTPUTS, solution.jacobian);
        solution.weight = contexts->context[j].recent;
        insert(prediction, learner->config.n_solutions_max, &solution);
    }
    share(prediction);
    return prediction->n_solutions;
}

/* The mean of all contexts' answers, by weight. */
static int predict_single(void *self, const double *z, struct learner_solution *mean)
{
    struct body_learner *learner = self;
    struct learner_prediction prediction = {0};
    int slopes = learner->config.n_inputs * BODY_OUTPUTS;

    if (!learner->found)
        return imle_predict_single(learner->meanwhile, z, mean);
    if (predict(self, z, &prediction) == 0)
        return 0;
    *mean = (struct learner_solution){.principal = prediction.solution[0].principal, .weight = 1.0};
    for (int s = 0; s < prediction.n_solutions; s++) {
        const struct learner_solution *one = &prediction.solution[s];
        mean->members++;
        for (int r = 0; r < BODY_OUTPUTS; r++)
            mean->value[r] += one->weight * one->value[r];
        for (int i = 0; i < slopes; i++)
            mean->jacobian[i] += one->weight * one->jacobian[i];
    }
    for (int s = 0; s < prediction.n_solutions; s++)
        for (int r = 0; r < BODY_OUTPUTS; r++) {
            const struct learner_solution *one = &prediction.solution[s];
            double apart = one->value[r] - mean->value[r];
            mean->variance[r] += one->weight * (one->variance[r] + apart * apart);
        }
    return 1;
}

static int experts(const void *self)
{
    const struct body_learner *learner = self;

    if (!learner->found)
        return learner_imle_ops.experts(learner->meanwhile);
    return learner->contexts->n < learner->contexts->most ? learner->contexts->n
                                                          : learner->contexts->most;
}

static int saved_experts(const void *self)
{
    const struct body_learner *learner = self;

    return imle_saved_experts(learner->meanwhile);
}

/* What the contexts have kept waits for another body. */
static void forget_body(struct body_learner *learner)
{
    double inputs[LEARNER_MAX_INPUTS];

    learner->given_up = 0.0;
    if (!learner->found)
        return;
    learner->found = learner->doubtful = false;
    learner->contest = contest_begin();
    imle_forget(learner->meanwhile);
    kept_clear(&learner->waiting);
    for (int j = 0; j < learner->contexts->n; j++) {
        const struct kept *kept = &learner->contexts->context[j].kept;
        for (int i = 0; i < kept->n; i++) {
            const double *joints = kept->z + (ptrdiff_t)i * kept->n_inputs;
            const double *x = kept->x + (ptrdiff_t)i * BODY_OUTPUTS;
            kept_add(&learner->waiting, joints, x);
            memcpy(inputs, joints, (size_t)kept->n_inputs * sizeof *joints);
            order_to_inputs(&learner->config, 1, inputs);
            imle_learn(learner->meanwhile, inputs, x);
        }
    }
    contexts_forget(learner->contexts);
}

static int give_body(void *self, const struct body *body, char *err, size_t err_size)
{
    struct body_learner *learner = self;
    const struct kept *waiting = &learner->waiting;
    bool first = !learner->found;

    if (body->chain.n == 0) {
        forget_body(learner);
        return 0;
    }
    if (body->chain.n != learner->config.n_inputs) {
        snprintf(err, err_size, "the body has %d joints, the learner %d inputs", body->chain.n,
                 learner->config.n_inputs);
        return -1;
    }
    if (body->sees != (learner->config.body.space == LEARNER_BODY_EYES)) {
        snprintf(err, err_size, "the body's outputs are not what body.space says");
        return -1;
    }
    if (body_check(body, err, err_size) != 0)
        return -1;
    if (learner->given_up > 0.0 && body->error * body->error >= learner->given_up) {
        snprintf(err, err_size,
                 "polynomials foretell better than a body that is off by %.1f times "
                 "the noise",
                 body->error);
        return -1;
    }
    learner->found = true;
    learner->given_up = 0.0;
    body_begin_trial(learner, body);
    learner->contexts->firm = !learner->doubtful; /* also of one that was just loaded */
    contexts_stand_on(learner->contexts, body);
    for (int i = 0; first && i < waiting->n; i++)
        contexts_learn(learner->contexts, waiting->z + (ptrdiff_t)i * waiting->n_inputs,
                       waiting->x + (ptrdiff_t)i * BODY_OUTPUTS);
    return 0;
}

static const struct body *body_of(const void *self)
{
    const struct body_learner *learner = self;

    return learner->found ? &learner->body : NULL;
}

static struct learner_body_change change_of(const void *self)
{
    const struct body_learner *learner = self;
    const struct body_news *news = &learner->contexts->news;
    struct learner_body_change change = {.changes = (uint64_t)news->changes, .cause = news->cause};

    memcpy(change.by, news->by, sizeof change.by);
    change.unsettled = follow_unsettled(learner->contexts);
    if (change.cause >= 0 && change.cause < learner->config.n_inputs)
        change.cause = learner->config.body.order[change.cause];
    for (int j = 0; j < learner->contexts->n; j++)
        change.slip = fmax(change.slip, learner->contexts->context[j].slip);
    return change;
}

static struct learner_samples kept_samples(const void *self, int context)
{
    const struct body_learner *learner = self;
    const struct kept *kept = context == 0 ? &learner->waiting : NULL;

    if (learner->found)
        kept = context < learner->contexts->n ? &learner->contexts->context[context].kept : NULL;
    if (!kept)
        return (struct learner_samples){0};
    bool rigid = !learner->found || learner->contexts->context[context].tied.chosen == 0;
    return (struct learner_samples){rigid, kept->n, kept->z, kept->x};
}

const struct learner_ops learner_body_ops = {
    .number = 3,
    .check = check,
    .hash = hash_meanwhile,
    .memory = memory,
    .create = create,
    .update = update,
    .predict = predict,
    .predict_single = predict_single,
    .predict_inverse = body_predict_inverse,
    .experts = experts,
    .saved_experts = saved_experts,
    .state_size = body_state_size,
    .give_body = give_body,
    .body = body_of,
    .not_rigid = body_not_rigid,
    .body_change = change_of,
    .kept_samples = kept_samples,
    .save = body_save,
    .load = body_load,
};
