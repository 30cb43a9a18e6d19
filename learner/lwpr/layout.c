/* Where everything of the receptive fields lies in memory, and which of it is state. */
#include <string.h>

#include "learner/lwpr/lwpr.h"

enum part {
    PART_HEAD,
    PART_CENTRE,
    PART_ROOT,
    PART_RATE,
    PART_MEAN,
    PART_STAGE,
    PART_COVARIANCE,
    PART_SZ,
    PART_DIRECTION, /* from here on derived */
    PART_LOADING,
};

_Static_assert(PART_LOADING + 1 == LWPR_PARTS, "every part has its place");

static void set_widths(struct lwpr *m)
{
    size_t d = (size_t)m->d * sizeof(double);
    size_t root = (size_t)m->n_root * sizeof(double);
    size_t R = (size_t)m->R;
    const size_t width[LWPR_PARTS] = {
        [PART_HEAD] = sizeof(struct lwpr_head),
        [PART_CENTRE] = d,
        [PART_ROOT] = root,
        [PART_RATE] = root,
        [PART_MEAN] = d,
        [PART_STAGE] = R * sizeof(struct lwpr_stage),
        [PART_COVARIANCE] = R * d,
        [PART_SZ] = R * d,
        [PART_DIRECTION] = R * d,
        [PART_LOADING] = R * d,
    };

    memcpy(m->width, width, sizeof width);
}

/* A block of the arena, or, without one, only its size added to the total. */
static void *take_block(struct arena *arena, size_t bytes, size_t *total)
{
    *total += arena_footprint(bytes);
    return arena ? arena_alloc(arena, bytes) : NULL;
}

size_t lwpr_layout(struct lwpr *m, struct arena *arena)
{
    size_t places = (size_t)m->config.capacity + 1; /* one to look at what is to be loaded */
    size_t total = 0;
    bool complete = true;

    set_widths(m);
    for (int k = 0; k < LWPR_PARTS; k++) {
        m->part[k] = take_block(arena, places * m->width[k], &total);
        complete = complete && m->part[k];
    }
    m->u = take_block(arena, (size_t)m->d * sizeof *m->u, &total);
    m->q = take_block(arena, places * sizeof *m->q, &total);
    m->rank = take_block(arena, (size_t)m->D * sizeof *m->rank, &total);
    complete = complete && m->u && m->q && m->rank;
    return complete || !arena ? total : 0;
}

static void *part_of(const struct lwpr *m, int j, enum part part)
{
    return (unsigned char *)m->part[part] + (size_t)j * m->width[part];
}

struct lwpr_field lwpr_field_at(const struct lwpr *m, int j)
{
    return (struct lwpr_field){
        .head = part_of(m, j, PART_HEAD),
        .centre = part_of(m, j, PART_CENTRE),
        .root = part_of(m, j, PART_ROOT),
        .rate = part_of(m, j, PART_RATE),
        .mean = part_of(m, j, PART_MEAN),
        .stage = part_of(m, j, PART_STAGE),
        .covariance = part_of(m, j, PART_COVARIANCE),
        .SZ = part_of(m, j, PART_SZ),
        .direction = part_of(m, j, PART_DIRECTION),
        .loading = part_of(m, j, PART_LOADING),
    };
}

void *lwpr_state_part(const struct lwpr *m, int j, int k, size_t *bytes)
{
    if (k >= PART_DIRECTION)
        return NULL;
    *bytes = m->width[k];
    return part_of(m, j, (enum part)k);
}
