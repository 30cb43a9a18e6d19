/* What all learners share: which implementation, checks of what comes from outside, counts, and the
 * envelope of a saved state. */
#include "learner/kind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/base/hash.h"

struct learner {
    const struct learner_ops *ops;
    void *self;
    struct learner_config config;
    struct learner_statistics counts; /* experts and capacity are filled in when asked for */
};

/* A saved state begins with these; the implementation's bytes follow. */
struct envelope {
    char magic[8];
    uint64_t version;
    uint64_t kind; /* learner_ops.number */
    uint64_t n_inputs;
    uint64_t n_outputs;
    uint64_t parameters; /* learner_config_hash() */
    uint64_t experts;
    uint64_t size; /* of everything */
    uint64_t samples;
    uint64_t births;
    uint64_t outliers;
    uint64_t full;
    uint64_t refused;
    uint64_t checksum; /* of everything after the envelope, continued over the fields above */
};

_Static_assert(offsetof(struct envelope, experts) == LEARNER_SAVED_IDENTITY,
               "what comes before says whose state it is");

static const char magic[8] = "RLEARNER";
static const uint64_t version = 5;

static size_t memory_of(const struct learner_config *config)
{
    return arena_footprint(sizeof(struct learner)) + learner_ops_of(config)->memory(config);
}

/* The configuration with no more experts than most_bytes has room for, but one at least. */
static struct learner_config bounded_by_memory(struct learner_config config)
{
    int low = 1;
    int high = config.capacity;

    while (low < high) {
        config.capacity = high - (high - low) / 2;
        if ((double)memory_of(&config) <= config.most_bytes)
            low = config.capacity;
        else
            high = config.capacity - 1;
    }
    config.capacity = low;
    return config;
}

size_t learner_memory(const struct learner_config *config)
{
    char ignored[128];

    if (learner_config_check(config, ignored, sizeof ignored) != 0)
        return 0;
    struct learner_config within = bounded_by_memory(*config);
    return memory_of(&within);
}

struct learner *learner_create(const struct learner_config *config, struct arena *arena, char *err,
                               size_t err_size)
{
    if (learner_config_check(config, err, err_size) != 0)
        return NULL;
    struct learner *learner = arena_alloc(arena, sizeof *learner);
    if (learner) {
        learner->ops = learner_ops_of(config);
        learner->config = bounded_by_memory(*config);
        learner->self = learner->ops->create(&learner->config, arena);
    }
    if (!learner || !learner->self) {
        snprintf(err, err_size, "the learner needs %zu bytes, the arena has too few",
                 learner_memory(config));
        return NULL;
    }
    return learner;
}

static bool all_usable(int n, const double *numbers)
{
    for (int i = 0; i < n; i++)
        if (!(fabs(numbers[i]) <= LEARNER_LARGEST_NUMBER))
            return false;
    return true;
}

enum learner_update_result learner_update(struct learner *learner, const double *z, const double *x)
{
    struct learner_statistics *counts = &learner->counts;
    enum learner_update_result result = LEARNER_REFUSED;

    if (all_usable(learner->config.n_inputs, z) && all_usable(learner->config.n_outputs, x))
        result = learner->ops->update(learner->self, z, x);
    counts->samples += result == LEARNER_UPDATED || result == LEARNER_BORN;
    counts->births += result == LEARNER_BORN;
    counts->outliers += result == LEARNER_OUTLIER;
    counts->full += result == LEARNER_FULL;
    counts->refused += result == LEARNER_REFUSED;
    return result;
}

int learner_predict(struct learner *learner, const double *z, struct learner_prediction *prediction)
{
    prediction->n_solutions = 0;
    if (!all_usable(learner->config.n_inputs, z))
        return 0;
    prediction->n_solutions = learner->ops->predict(learner->self, z, prediction);
    return prediction->n_solutions;
}

int learner_predict_single(struct learner *learner, const double *z,
                           struct learner_solution *solution)
{
    if (!all_usable(learner->config.n_inputs, z))
        return 0;
    return learner->ops->predict_single(learner->self, z, solution);
}

int learner_predict_inverse(struct learner *learner, const double *x,
                            struct learner_inverse *inverse)
{
    inverse->n_solutions = 0;
    if (!all_usable(learner->config.n_outputs, x))
        return 0;
    inverse->n_solutions = learner->ops->predict_inverse(learner->self, x, inverse);
    return inverse->n_solutions;
}

struct learner_statistics learner_get_statistics(const struct learner *learner)
{
    struct learner_statistics statistics = learner->counts;

    statistics.experts = learner->ops->experts(learner->self);
    statistics.capacity = learner->config.capacity;
    return statistics;
}

int learner_give_body(struct learner *learner, const struct body *body, char *err, size_t err_size)
{
    if (learner->ops->give_body)
        return learner->ops->give_body(learner->self, body, err, err_size);
    snprintf(err, err_size, "only a learner with experts: body takes one");
    return -1;
}

const struct body *learner_body(const struct learner *learner)
{
    return learner->ops->body ? learner->ops->body(learner->self) : NULL;
}

struct learner_samples learner_kept_samples(const struct learner *learner, int context)
{
    struct learner_samples none = {0};

    return learner->ops->kept_samples ? learner->ops->kept_samples(learner->self, context) : none;
}

int learner_not_rigid(struct learner *learner, double share[LEARNER_MAX_OUTPUTS])
{
    return learner->ops->not_rigid ? learner->ops->not_rigid(learner->self, share) : -1;
}

struct learner_body_change learner_get_body_change(const struct learner *learner)
{
    struct learner_body_change none = {.cause = -1};

    return learner->ops->body_change ? learner->ops->body_change(learner->self) : none;
}

static uint64_t checksum(const struct envelope *envelope, const unsigned char *state, size_t n)
{
    uint64_t hash = learner_hash(LEARNER_HASH_START, state, n);

    return learner_hash(hash, envelope, offsetof(struct envelope, checksum));
}

static int saved_experts(const struct learner *learner)
{
    const struct learner_ops *ops = learner->ops;

    return ops->saved_experts ? ops->saved_experts(learner->self) : ops->experts(learner->self);
}

size_t learner_save_size(const struct learner *learner)
{
    return sizeof(struct envelope) +
           learner->ops->state_size(learner->self, saved_experts(learner));
}

size_t learner_save(const struct learner *learner, void *buffer, size_t size)
{
    const struct learner_statistics *counts = &learner->counts;
    unsigned char *state = (unsigned char *)buffer + sizeof(struct envelope);
    struct envelope envelope = {
        .version = version,
        .kind = learner->ops->number,
        .n_inputs = (uint64_t)learner->config.n_inputs,
        .n_outputs = (uint64_t)learner->config.n_outputs,
        .parameters = learner_config_hash(&learner->config),
        .experts = (uint64_t)saved_experts(learner),
        .size = learner_save_size(learner),
        .samples = counts->samples,
        .births = counts->births,
        .outliers = counts->outliers,
        .full = counts->full,
        .refused = counts->refused,
    };

    if (envelope.size > size)
        return 0;
    memcpy(envelope.magic, magic, sizeof magic);
    learner->ops->save(learner->self, state);
    envelope.checksum = checksum(&envelope, state, envelope.size - sizeof envelope);
    memcpy(buffer, &envelope, sizeof envelope);
    return envelope.size;
}

/* NULL when the envelope fits this learner, otherwise the reason. */
static const char *envelope_fault(const struct learner *learner, const struct envelope *envelope,
                                  const unsigned char *state, size_t size)
{
    const struct learner_config *config = &learner->config;

    if (memcmp(envelope->magic, magic, sizeof magic) != 0)
        return "not a saved learner";
    if (envelope->version != version)
        return "saved by another version";
    if (envelope->size != size)
        return "cut short or with bytes too many";
    if (envelope->checksum != checksum(envelope, state, size - sizeof *envelope))
        return "damaged: the checksum does not match";
    if (envelope->kind != learner->ops->number)
        return "saved by another kind of learner";
    if (envelope->n_inputs != (uint64_t)config->n_inputs ||
        envelope->n_outputs != (uint64_t)config->n_outputs)
        return "saved with other dimensions";
    if (envelope->parameters != learner_config_hash(config))
        return "saved with other parameters";
    if (envelope->experts > (uint64_t)config->capacity)
        return "it has more experts than the capacity";
    if (size != sizeof *envelope + learner->ops->state_size(learner->self, (int)envelope->experts))
        return "its size does not match its number of experts";
    return NULL;
}

int learner_load(struct learner *learner, const void *buffer, size_t size, char *err,
                 size_t err_size)
{
    const unsigned char *state = (const unsigned char *)buffer + sizeof(struct envelope);
    struct envelope envelope;

    if (size < sizeof envelope) {
        snprintf(err, err_size, "cut short: %zu bytes are less than a header", size);
        return -1;
    }
    memcpy(&envelope, buffer, sizeof envelope);
    const char *fault = envelope_fault(learner, &envelope, state, size);
    if (fault) {
        snprintf(err, err_size, "%s", fault);
        return -1;
    }
    if (learner->ops->load(learner->self, (int)envelope.experts, state, err, err_size) != 0)
        return -1;
    learner->counts = (struct learner_statistics){
        .samples = envelope.samples,
        .births = envelope.births,
        .outliers = envelope.outliers,
        .full = envelope.full,
        .refused = envelope.refused,
    };
    return 0;
}
