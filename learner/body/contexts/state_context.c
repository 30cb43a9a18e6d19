/* A context of a saved state, and what it keeps. */
#include <math.h>
#include <string.h>

#include "learner/body/contexts/state_private.h"

/* One number a field, so that no padding is saved. */
enum { CONTEXT_HEAD = 12, ANCHOR_HEAD = 8, KEPT_HEAD = 3 };

const double state_most_counted = 1e15;
static const double most_summed = 1e30;

size_t state_context_numbers(const struct design *design)
{
    return CONTEXT_HEAD + DESIGN_SIZES + whitener_row(design->size[2]) + (size_t)design->size[2] +
           ANCHOR_HEAD + contexts_anchor_numbers(design) + KEPT_HEAD +
           kept_numbers(CONTEXTS_KEPT, design->n_joints, BODY_OUTPUTS);
}

void state_write(struct writer *writer, size_t n, const double *numbers)
{
    memcpy(writer->to, numbers, n * sizeof *numbers);
    writer->to += n * sizeof *numbers;
}

void state_write_kept(struct writer *writer, const struct kept *kept)
{
    double head[3] = {kept->n, kept->spacing, kept->offered};
    size_t room = (size_t)kept->capacity;

    state_write(writer, 3, head);
    state_write(writer, room * (size_t)kept->n_inputs, kept->z);
    state_write(writer, room * (size_t)kept->n_outputs, kept->x);
    state_write(writer, room, kept->at);
}

static void write_anchor(struct writer *writer, const struct design *design,
                         const struct anchor *anchor)
{
    double head[ANCHOR_HEAD] = {anchor->known,         anchor->slips,         anchor->size,
                                anchor->next,          anchor->own.weight,    anchor->own.squares,
                                anchor->astray.weight, anchor->astray.squares};

    state_write(writer, ANCHOR_HEAD, head);
    state_write(writer, contexts_anchor_numbers(design), anchor->theta);
}

void state_write_context(struct writer *writer, const struct design *design,
                         const struct context *context)
{
    const struct tied *tied = &context->tied;
    double head[CONTEXT_HEAD] = {context->support, context->recent, context->age,
                                 context->scale,   context->twin,   tied->turn,
                                 tied->chosen,     context->gain,   context->confirmed,
                                 context->number,  context->strain, context->slip};

    state_write(writer, CONTEXT_HEAD, head);
    state_write(writer, DESIGN_SIZES, tied->evidence);
    state_write(writer, whitener_row(design->size[2]), tied->G);
    state_write(writer, (size_t)design->size[2], tied->b);
    write_anchor(writer, design, &context->anchor);
    state_write_kept(writer, &context->kept);
}

void state_read_head(struct reader *reader, size_t n, double *numbers)
{
    memcpy(numbers, reader->from, n * sizeof *numbers);
    reader->from += n * sizeof *numbers;
    for (size_t i = 0; i < n; i++)
        reader->fits = reader->fits && fabs(numbers[i]) < 1e300;
}

void state_read(struct reader *reader, size_t n, double *numbers)
{
    double number = 0.0;

    for (size_t i = 0; i < n; i++) {
        state_read_head(reader, 1, &number);
        if (reader->into_place)
            numbers[i] = number;
    }
}

void state_demand(struct reader *reader, bool right)
{
    reader->fits = reader->fits && right;
}

int state_whole(struct reader *reader, double number, int least, int most)
{
    state_demand(reader, number >= least && number <= most && number == (int)number);
    return reader->fits ? (int)number : least;
}

/* Numbers that a learner may have been given. */
static void read_samples(struct reader *reader, size_t n, double *numbers)
{
    double number = 0.0;

    for (size_t i = 0; i < n; i++) {
        state_read_head(reader, 1, &number);
        state_demand(reader, fabs(number) <= LEARNER_LARGEST_NUMBER);
        if (reader->into_place)
            numbers[i] = number;
    }
}

static void read_times(struct reader *reader, int n, double offered, struct kept *kept)
{
    double at = 0.0;

    for (int i = 0; i < kept->capacity; i++) {
        state_read_head(reader, 1, &at);
        state_demand(reader, i >= n || (at >= 0.0 && at <= offered));
        if (reader->into_place)
            kept->at[i] = at;
    }
}

void state_read_kept(struct reader *reader, struct kept *kept)
{
    size_t room = (size_t)kept->capacity;
    double head[3];

    state_read_head(reader, 3, head);
    int n = state_whole(reader, head[0], 0, kept->capacity);
    state_demand(reader, head[1] > 0.0 && head[2] >= n && head[2] < state_most_counted);
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
        state_read(reader, (size_t)i, G + whitener_row(i));
        state_read_head(reader, 1, &diagonal);
        state_demand(reader, !used || diagonal > 0.0);
        if (reader->into_place)
            G[whitener_row(i) + (size_t)i] = diagonal;
    }
}

static void read_anchor(struct reader *reader, const struct design *design, bool used,
                        struct anchor *anchor)
{
    double head[ANCHOR_HEAD];

    state_read_head(reader, ANCHOR_HEAD, head);
    bool known = state_whole(reader, head[0], 0, 1) != 0;
    bool slips = state_whole(reader, head[1], 0, 1) != 0;
    int size = state_whole(reader, head[2], 0, design->size[2]);
    for (int k = 3; k < ANCHOR_HEAD; k++)
        state_demand(reader, !used || (head[k] >= 0.0 && head[k] <= most_summed));
    if (reader->into_place) {
        anchor->known = known;
        anchor->slips = slips;
        anchor->size = size;
        anchor->next = head[3];
        anchor->own.weight = head[4];
        anchor->own.squares = head[5];
        anchor->astray.weight = head[6];
        anchor->astray.squares = head[7];
    }
    state_read(reader, contexts_anchor_numbers(design), anchor->theta);
}

/* Returns whether it is confirmed. */
bool state_read_context(struct reader *reader, const struct design *design, bool used,
                        struct context *context)
{
    struct tied *tied = &context->tied;
    double head[CONTEXT_HEAD];

    state_read_head(reader, CONTEXT_HEAD, head);
    int turn = state_whole(reader, head[5], 0, design->size[2] - 1);
    int chosen = state_whole(reader, head[6], 0, DESIGN_SIZES - 1);
    bool confirmed = state_whole(reader, head[8], 0, 1) != 0;
    state_demand(reader,
                 !used || (head[0] >= 0.0 && head[0] < state_most_counted && head[1] >= 0.0 &&
                           head[1] <= 1.0 && head[2] >= 0.0 && head[2] < state_most_counted &&
                           head[3] >= 1.0 && head[4] >= 0.0 && head[4] < state_most_counted &&
                           head[9] >= 0.0 && head[9] < CONTEXTS_NUMBERS && head[10] >= 0.0 &&
                           head[10] < state_most_counted && head[11] >= 0.0 &&
                           head[11] < state_most_counted));
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
        context->slip = head[11];
        tied->turn = turn;
        tied->chosen = chosen;
    }
    state_read(reader, DESIGN_SIZES, tied->evidence);
    read_whitener(reader, design->size[2], used, tied->G);
    state_read(reader, (size_t)design->size[2], tied->b);
    read_anchor(reader, design, used, &context->anchor);
    state_read_kept(reader, &context->kept);
    return used && confirmed;
}
