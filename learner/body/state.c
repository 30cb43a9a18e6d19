/* The state as bytes, and back: the body, the contexts with what they keep, the samples that wait
 * for a body, and the mixture that answers meanwhile, empty once there is a body. Its size depends
 * on the mixture's experts alone. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/body/body_learner.h"

/* One number a field, so that no padding is saved. */
enum {
    CONTEXT_HEAD = 11,
    CONTEXT_NUMBERS = CONTEXT_HEAD + DESIGN_SIZES + 3
}; /* with those of what it keeps */

static size_t regression_numbers(const struct design *design)
{
    return whitener_row(design->size[2]) + (size_t)design->size[2];
}

static size_t fixed_numbers(const struct body_learner *learner)
{
    size_t d = (size_t)learner->config.n_inputs;
    size_t each = CONTEXT_NUMBERS + regression_numbers(&learner->contexts->design) +
                  kept_numbers(CONTEXTS_KEPT, (int)d, BODY_OUTPUTS);

    return 4 + BODY_NUMBERS + CONTEXTS_ROOM * each + 3 +
           kept_numbers(BODY_WAITING, (int)d, BODY_OUTPUTS);
}

size_t body_state_size(const void *self, int n_experts)
{
    const struct body_learner *learner = self;

    return fixed_numbers(learner) * sizeof(double) +
           learner_imle_ops.state_size(learner->meanwhile, n_experts);
}

struct writer {
    unsigned char *to;
};

static void write_numbers(struct writer *writer, size_t n, const double *numbers)
{
    memcpy(writer->to, numbers, n * sizeof *numbers);
    writer->to += n * sizeof *numbers;
}

static void write_kept(struct writer *writer, const struct kept *kept)
{
    double head[3] = {kept->n, kept->spacing, kept->offered};
    size_t room = (size_t)kept->capacity;

    write_numbers(writer, 3, head);
    write_numbers(writer, room * (size_t)kept->n_inputs, kept->z);
    write_numbers(writer, room * (size_t)kept->n_outputs, kept->x);
    write_numbers(writer, room, kept->at);
}

static void write_context(struct writer *writer, const struct design *design,
                          const struct context *context)
{
    const struct tied *tied = &context->tied;
    double head[CONTEXT_HEAD] = {context->support, context->recent, context->age,
                                 context->scale,   context->twin,   tied->turn,
                                 tied->chosen,     context->gain,   context->confirmed,
                                 context->number,  context->strain};

    write_numbers(writer, CONTEXT_HEAD, head);
    write_numbers(writer, DESIGN_SIZES, tied->evidence);
    write_numbers(writer, whitener_row(design->size[2]), tied->G);
    write_numbers(writer, (size_t)design->size[2], tied->b);
    write_kept(writer, &context->kept);
}

void body_save(const void *self, unsigned char *buffer)
{
    const struct body_learner *learner = self;
    struct writer writer = {buffer};
    double head[4] = {learner->found, learner->contexts->n, learner->meanwhile->state.M,
                      learner->contexts->births};
    double numbers[BODY_NUMBERS];

    write_numbers(&writer, 4, head);
    body_to_numbers(&learner->body, numbers);
    write_numbers(&writer, BODY_NUMBERS, numbers);
    for (int j = 0; j < CONTEXTS_ROOM; j++)
        write_context(&writer, &learner->contexts->design, &learner->contexts->context[j]);
    write_kept(&writer, &learner->waiting);
    learner_imle_ops.save(learner->meanwhile, writer.to);
}

/* Counts stay whole numbers up to here; no robot offers as many samples. */
static const double most_counted = 1e15;

/* Reads twice: first only to see whether everything fits, then into its place. */
struct reader {
    const unsigned char *from;
    bool fits;
    bool into_place;
};

static void read_head(struct reader *reader, size_t n, double *numbers)
{
    memcpy(numbers, reader->from, n * sizeof *numbers);
    reader->from += n * sizeof *numbers;
    for (size_t i = 0; i < n; i++)
        reader->fits = reader->fits && fabs(numbers[i]) < 1e300;
}

static void read_numbers(struct reader *reader, size_t n, double *numbers)
{
    double number = 0.0;

    for (size_t i = 0; i < n; i++) {
        read_head(reader, 1, &number);
        if (reader->into_place)
            numbers[i] = number;
    }
}

static void demand(struct reader *reader, bool right)
{
    reader->fits = reader->fits && right;
}

static int whole(struct reader *reader, double number, int least, int most)
{
    demand(reader, number >= least && number <= most && number == (int)number);
    return reader->fits ? (int)number : least;
}

/* Numbers that a learner may have been given. */
static void read_samples(struct reader *reader, size_t n, double *numbers)
{
    double number = 0.0;

    for (size_t i = 0; i < n; i++) {
        read_head(reader, 1, &number);
        demand(reader, fabs(number) <= LEARNER_LARGEST_NUMBER);
        if (reader->into_place)
            numbers[i] = number;
    }
}

static void read_times(struct reader *reader, int n, double offered, struct kept *kept)
{
    double at = 0.0;

    for (int i = 0; i < kept->capacity; i++) {
        read_head(reader, 1, &at);
        demand(reader, i >= n || (at >= 0.0 && at <= offered));
        if (reader->into_place)
            kept->at[i] = at;
    }
}

static void read_kept(struct reader *reader, struct kept *kept)
{
    size_t room = (size_t)kept->capacity;
    double head[3];

    read_head(reader, 3, head);
    int n = whole(reader, head[0], 0, kept->capacity);
    demand(reader, head[1] > 0.0 && head[2] >= n && head[2] < most_counted);
    if (reader->into_place) {
        kept->n = n;
        kept->spacing = head[1];
        kept->offered = head[2];
    }
    read_samples(reader, room * (size_t)kept->n_inputs, kept->z);
    read_samples(reader, room * (size_t)kept->n_outputs, kept->x);
    read_times(reader, n, head[2], kept);
}

static void read_whitener(struct reader *reader, int n, bool used, double *G)
{
    for (int i = 0; i < n; i++) {
        double diagonal = 0.0;
        read_numbers(reader, (size_t)i, G + whitener_row(i));
        read_head(reader, 1, &diagonal);
        demand(reader, !used || diagonal > 0.0);
        if (reader->into_place)
            G[whitener_row(i) + (size_t)i] = diagonal;
    }
}

/* Returns whether it is confirmed. */
static bool read_context(struct reader *reader, const struct design *design, bool used,
                         struct context *context)
{
    struct tied *tied = &context->tied;
    double head[CONTEXT_HEAD];

    read_head(reader, CONTEXT_HEAD, head);
    int turn = whole(reader, head[5], 0, design->size[2] - 1);
    int chosen = whole(reader, head[6], 0, DESIGN_SIZES - 1);
    bool confirmed = whole(reader, head[8], 0, 1) != 0;
    demand(reader,
           !used || (head[0] >= 0.0 && head[0] < most_counted && head[1] >= 0.0 && head[1] <= 1.0 &&
                     head[2] >= 0.0 && head[2] < most_counted && head[3] >= 1.0 && head[4] >= 0.0 &&
                     head[4] < most_counted && head[9] >= 0.0 && head[9] < CONTEXTS_NUMBERS &&
                     head[10] >= 0.0 && head[10] < most_counted));
    if (reader->into_place) {
        context->support = head[0];
        context->recent = head[1];
        context->age = head[2];
        context->scale = head[3];
        context->twin = head[4];
        context->gain = head[7];
        context->confirmed = confirmed;
        context->number = head[9];
        context->strain = head[10];
        tied->turn = turn;
        tied->chosen = chosen;
    }
    read_numbers(reader, DESIGN_SIZES, tied->evidence);
    read_whitener(reader, design->size[2], used, tied->G);
    read_numbers(reader, (size_t)design->size[2], tied->b);
    read_kept(reader, &context->kept);
    return used && confirmed;
}

static void read_body(struct reader *reader, bool found, int n_joints, struct body *body)
{
    double numbers[BODY_NUMBERS];
    struct body other;
    char ignored[128];

    read_head(reader, BODY_NUMBERS, numbers);
    body_from_numbers(numbers, &other);
    demand(reader, !found || (other.chain.n == n_joints &&
                              body_check(&other, ignored, sizeof ignored) == 0));
    if (reader->into_place)
        *body = other;
}

/* Returns the experts of the mixture, whose bytes are at reader->from then. */
static int read_all(struct reader *reader, struct body_learner *learner)
{
    struct contexts *contexts = learner->contexts;
    int confirmed = 0;
    double head[4];

    read_head(reader, 4, head);
    demand(reader, head[3] >= 0.0 && head[3] < most_counted && head[3] == (double)(int64_t)head[3]);
    bool found = whole(reader, head[0], 0, 1) != 0;
    int n = whole(reader, head[1], 0, found ? contexts->most + 1 : 0);
    int meanwhile = whole(reader, head[2], 0, found ? 0 : learner->config.capacity);
    read_body(reader, found, learner->config.n_inputs, &learner->body);
    if (reader->into_place) {
        learner->found = found;
        contexts->n = n;
        contexts->births = head[3];
    }
    for (int j = 0; j < CONTEXTS_ROOM; j++)
        confirmed += read_context(reader, &contexts->design, j < n, &contexts->context[j]);
    demand(reader, confirmed <= contexts->most);
    read_kept(reader, &learner->waiting);
    return meanwhile;
}

int body_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size)
{
    struct body_learner *learner = self;
    struct reader look = {buffer, true, false};
    struct reader take = {buffer, true, true};
    struct contexts *contexts = learner->contexts;
    int meanwhile = read_all(&look, learner);

    if (!look.fits || meanwhile != n_experts) {
        snprintf(err, err_size, "it holds numbers that no state can have");
        return -1;
    }
    if (learner_imle_ops.load(learner->meanwhile, n_experts, look.from, err, err_size) != 0)
        return -1;
    read_all(&take, learner);
    if (!learner->found)
        return 0;
    contexts->body = &learner->body;
    design_init(&contexts->design, &learner->body);
    for (int j = 0; j < contexts->n; j++)
        tied_refresh(&contexts->context[j].tied, &contexts->design, contexts->kernels,
                     &contexts->scratch);
    return 0;
}
