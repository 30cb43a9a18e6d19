#include "learner/service/desk.h"

#include "common/base/mailbox.h"
#include "learner/service/clients.h"
#include "learner/service/request_check.h"
#include "learner/store/model_file.h"

#include <string.h>

#define REPLY(name) REACH_LEARNER_REPLY_T_##name
#define REQUEST(name) REACH_LEARNER_REQUEST_T_##name

_Static_assert((int)LEARNER_UPDATED == REPLY(UPDATED) && (int)LEARNER_BORN == REPLY(BORN) &&
                   (int)LEARNER_OUTLIER == REPLY(OUTLIER) && (int)LEARNER_FULL == REPLY(FULL) &&
                   (int)LEARNER_REFUSED == REPLY(BEYOND),
               "learner_reply_t.learned is enum learner_update_result");
_Static_assert(1 << HEALTH_FULL == REPLY(MANY_FULL) &&
                   1 << HEALTH_OUTLIERS == REPLY(MANY_OUTLIERS) && 1 << HEALTH_FAR == REPLY(FAR) &&
                   1 << HEALTH_CONSTANT == REPLY(CONSTANT) && 1 << HEALTH_FROZEN == REPLY(STILL) &&
                   1 << HEALTH_EXPERTS == REPLY(EXPERTS) && HEALTH_TROUBLES == 6,
               "learner_reply_t.troubles has a bit for each enum health_trouble");

/* Somebody who waits for the disk, and for what. */
struct waiting {
    int64_t client;
    struct deed deed;
};

struct desk {
    int n_inputs, n_outputs;
    struct learner *learner;
    struct model_store *store;
    bool keeps;
    struct clients *clients;
    struct mailbox *waiting; /* struct waiting: updates, oldest first */
    bool saving;
    struct waiting save;
    struct health health;
    bool learns_frozen;
    int64_t frozen;
    int64_t requests, repeated, late, refused, dropped, malformed;
    struct learner_prediction prediction; /* for work */
    struct learner_inverse inverse;
};

size_t desk_memory(void)
{
    return arena_footprint(sizeof(struct desk)) + clients_memory() +
           mailbox_memory(sizeof(struct waiting), DESK_WAITING);
}

struct desk *desk_create(const struct learner_config *config, struct learner *learner,
                         struct model_store *store, bool keeps, struct arena *arena)
{
    struct desk *desk = arena_alloc(arena, sizeof *desk);

    if (!desk)
        return NULL;
    desk->n_inputs = config->n_inputs;
    desk->n_outputs = config->n_outputs;
    desk->learner = learner;
    desk->store = store;
    desk->keeps = keeps;
    health_init(&desk->health, config, HEALTH_WINDOW);
    desk->clients = clients_create(arena);
    desk->waiting = mailbox_create(arena, sizeof(struct waiting), DESK_WAITING);
    return desk->clients && desk->waiting ? desk : NULL;
}

void desk_learn_frozen(struct desk *desk)
{
    desk->learns_frozen = true;
}

unsigned desk_troubles(const struct desk *desk)
{
    const struct learner_statistics statistics = learner_get_statistics(desk->learner);

    return health_judge(&desk->health, &statistics);
}

void desk_tell(const struct desk *desk, enum health_trouble trouble, char *text, size_t size)
{
    const struct learner_statistics statistics = learner_get_statistics(desk->learner);

    health_tell(&desk->health, &statistics, trouble, text, size);
}

void desk_note_losses(struct desk *desk, int64_t dropped, int64_t malformed)
{
    desk->dropped = dropped;
    desk->malformed = malformed;
}

/* Returns a constant of learner_reply_t.body. */
static int8_t body_of(const struct desk *desk, const struct model_store_report *report)
{
    static const int8_t of_search[] = {[MODEL_STORE_SEARCHING] = REPLY(BODY_SEARCHING),
                                       [MODEL_STORE_NO_CHAIN] = REPLY(BODY_NO_CHAIN),
                                       [MODEL_STORE_NO_FINDER] = REPLY(BODY_NO_FINDER)};

    return learner_body(desk->learner) ? REPLY(BODY_FOUND) : of_search[report->search];
}

void desk_describe(const struct desk *desk, reach_learner_reply_t *reply)
{
    const struct learner_statistics statistics = learner_get_statistics(desk->learner);
    const struct model_store_report report = model_store_report(desk->store);

    *reply = (reach_learner_reply_t){
        .n_inputs = desk->n_inputs,
        .n_outputs = desk->n_outputs,
        .body = body_of(desk, &report),
        .experts = statistics.experts,
        .capacity = statistics.capacity,
        .samples = (int64_t)model_samples(desk->learner),
        .stored = report.stored,
        .storing = report.storing,
        .outliers = (int64_t)statistics.outliers,
        .full = (int64_t)statistics.full,
        .frozen = desk->frozen,
        .troubles = (int32_t)health_judge(&desk->health, &statistics),
        .requests = desk->requests,
        .repeated = desk->repeated,
        .late = desk->late,
        .refused = desk->refused,
        .dropped = desk->dropped,
        .malformed = desk->malformed,
    };
}

/* How the service is, and what became of a request. */
static void reply_to(struct desk *desk, int64_t client, const struct deed *deed, int64_t now,
                     reach_learner_reply_t *reply)
{
    desk->late += deed->status == REPLY(LATE);
    desk->refused += deed->status >= REPLY(UNKNOWN_KIND);
    desk_describe(desk, reply);
    reply->utime = now;
    reply->client = client;
    reply->seq = deed->seq;
    reply->kind = deed->kind;
    reply->status = deed->status;
    reply->learned = deed->learned;
    reply->sample = deed->sample;
    if (desk->keeps && deed->sample > reply->stored)
        reply->status = REPLY(NOT_STORED);
}

/* Returns a constant of learner_reply_t.learned. */
static int8_t learn(struct desk *desk, const reach_learner_request_t *request)
{
    bool sound = health_look(&desk->health, request->z, request->x);
    enum learner_update_result result;

    desk->frozen += !sound;
    if (!sound && !desk->learns_frozen)
        return REPLY(FROZEN);
    model_store_note(desk->store, request->z, request->x);
    result = learner_update(desk->learner, request->z, request->x);
    model_store_learned(desk->store, desk->learner);
    health_count(&desk->health, result);
    return (int8_t)result;
}

static int8_t update(struct desk *desk, const reach_learner_request_t *request, struct deed *deed)
{
    struct waiting waiting = {.client = request->client};

    if (!model_store_takes(desk->store) || (desk->keeps && mailbox_full(desk->waiting)))
        return REPLY(BUSY);
    deed->learned = learn(desk, request);
    deed->sample = (int64_t)model_samples(desk->learner);
    deed->waits = desk->keeps;
    waiting.deed = *deed;
    if (desk->keeps)
        mailbox_put(desk->waiting, &waiting);
    return REPLY(DONE);
}

static int8_t begin_save(struct desk *desk, const reach_learner_request_t *request,
                         struct deed *deed)
{
    if (desk->saving)
        return REPLY(BUSY);
    model_store_poll(desk->store, &desk->learner); /* so that it knows whether it is free */
    if (!model_store_begin_save(desk->store, request->number))
        return REPLY(BUSY);
    deed->waits = true;
    desk->saving = true;
    desk->save = (struct waiting){request->client, *deed};
    return REPLY(DONE);
}

/* An update or a save: once, however often it is asked for. */
static void act(struct desk *desk, const reach_learner_request_t *request, bool late,
                struct deed *deed)
{
    struct deed *place;

    switch (clients_look(desk->clients, request->client, request->seq, &place)) {
    case CLIENTS_UNKNOWN:
        deed->status = REPLY(UNKNOWN_CLIENT);
        break;
    case CLIENTS_FORGOTTEN:
        deed->status = REPLY(FORGOTTEN);
        break;
    case CLIENTS_REPEATED:
        desk->repeated++;
        *deed = *place;
        break;
    case CLIENTS_NEW:
        deed->status = late                               ? REPLY(LATE)
                       : request->kind == REQUEST(UPDATE) ? update(desk, request, deed)
                                                          : begin_save(desk, request, deed);
        if (deed->status == REPLY(DONE))
            *place = *deed;
        break;
    }
}

static void predict_forward(struct desk *desk, const double *z, reach_learner_prediction_t *out)
{
    const size_t n_inputs = (size_t)desk->n_inputs, n_outputs = (size_t)desk->n_outputs;

    out->n_solutions = learner_predict(desk->learner, z, &desk->prediction);
    health_count_solutions(&desk->health, out->n_solutions);
    for (int s = 0; s < out->n_solutions; s++) {
        const struct learner_solution *solution = &desk->prediction.solution[s];
        out->weight[s] = solution->weight;
        memcpy(out->x[s], solution->value, n_outputs * sizeof(double));
        memcpy(out->x_variance[s], solution->variance, n_outputs * sizeof(double));
        for (size_t row = 0; row < n_outputs; row++)
            memcpy(out->jacobian[s][row], solution->jacobian + row * n_inputs,
                   n_inputs * sizeof(double));
    }
}

static void predict_inverse(struct desk *desk, const double *x, reach_learner_prediction_t *out)
{
    const size_t n_inputs = (size_t)desk->n_inputs;

    out->n_solutions = learner_predict_inverse(desk->learner, x, &desk->inverse);
    for (int s = 0; s < out->n_solutions; s++) {
        const struct learner_inverse_solution *solution = &desk->inverse.solution[s];
        out->weight[s] = solution->weight;
        memcpy(out->z[s], solution->z, n_inputs * sizeof(double));
        memcpy(out->z_variance[s], solution->variance, n_inputs * sizeof(double));
    }
}

static void predict(struct desk *desk, const reach_learner_request_t *request, int64_t now,
                    reach_learner_prediction_t *out)
{
    *out = (reach_learner_prediction_t){
        .utime = now,
        .client = request->client,
        .seq = request->seq,
        .kind = request->kind,
        .samples = (int64_t)model_samples(desk->learner),
        .n_inputs = desk->n_inputs,
        .n_outputs = desk->n_outputs,
    };
    if (request->kind == REQUEST(PREDICT))
        predict_forward(desk, request->z, out);
    else
        predict_inverse(desk, request->x, out);
}

/* What became of it, unless that is not known yet. */
static enum desk_answer tell(struct desk *desk, int64_t client, const struct deed *deed,
                             int64_t now, struct desk_output *output)
{
    if (deed->waits)
        return DESK_SILENT;
    reply_to(desk, client, deed, now, &output->reply);
    return DESK_REPLY;
}

static bool is_late(const reach_learner_request_t *request, int64_t waited)
{
    int64_t patience;

    if (request->deadline == 0)
        return false;
    if (__builtin_sub_overflow(request->deadline, request->utime, &patience))
        return request->deadline < request->utime;
    return waited > patience;
}

enum desk_answer desk_take(struct desk *desk, const reach_learner_request_t *request,
                           int64_t waited, int64_t now, struct desk_output *output)
{
    const bool late = is_late(request, waited);
    const bool acts = request->kind == REQUEST(UPDATE) || request->kind == REQUEST(SAVE);
    struct deed deed = {.seq = request->seq, .kind = request->kind};

    desk->requests++;
    deed.status = request_check(request, desk->n_inputs, desk->n_outputs, desk->keeps);
    if (deed.status == REPLY(DONE) && acts)
        act(desk, request, late, &deed);
    else if (deed.status == REPLY(DONE) && late)
        deed.status = REPLY(LATE);
    if (deed.status != REPLY(DONE) || acts)
        return tell(desk, request->client, &deed, now, output);
    if (request->kind != REQUEST(STATISTICS)) {
        predict(desk, request, now, &output->prediction);
        return DESK_PREDICTION;
    }
    clients_admit(desk->clients, request->client, request->seq);
    return tell(desk, request->client, &deed, now, output);
}

/* Answers, and remembers that it was answered. */
static void answer_waiting(struct desk *desk, struct waiting *waiting, int64_t now,
                           reach_learner_reply_t *reply)
{
    struct deed *place;

    waiting->deed.waits = false;
    if (clients_look(desk->clients, waiting->client, waiting->deed.seq, &place) == CLIENTS_REPEATED)
        *place = waiting->deed;
    reply_to(desk, waiting->client, &waiting->deed, now, reply);
}

static bool update_is_due(struct desk *desk, struct waiting *waiting)
{
    const struct model_store_report report = model_store_report(desk->store);

    return mailbox_peek(desk->waiting, waiting) &&
           (waiting->deed.sample <= report.stored || !report.storing) &&
           mailbox_take(desk->waiting, waiting);
}

/* A body that was found takes its place here, too. */
static bool save_is_due(struct desk *desk)
{
    enum model_store_result result = model_store_poll(desk->store, &desk->learner);

    if (!desk->saving || result == MODEL_STORE_NOTHING)
        return false;
    if (result == MODEL_STORE_FAILED)
        desk->save.deed.status = REPLY(FAILED);
    desk->saving = false;
    return true;
}

bool desk_due(struct desk *desk, int64_t now, reach_learner_reply_t *reply)
{
    struct waiting waiting;

    if (update_is_due(desk, &waiting)) {
        answer_waiting(desk, &waiting, now, reply);
        return true;
    }
    if (!save_is_due(desk))
        return false;
    answer_waiting(desk, &desk->save, now, reply);
    return true;
}
