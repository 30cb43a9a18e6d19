/* Where everything of the mixture lies in memory, and which of it is state. */
#include <string.h>

#include "daemon/imle_private.h"
#include "daemon/imle_triangle.h"

/* One array: where its pointer is kept and how many bytes it takes. */
struct array {
    void *slot; /* a pointer to numbers or structs */
    size_t bytes;
};

static size_t numbers(size_t count)
{
    return count * sizeof(double);
}

/* Takes a list of arrays; returns the bytes needed, or 0 when the arena is exhausted. */
static size_t take(const struct array *arrays, size_t n, struct arena *arena)
{
    size_t total = 0;

    for (size_t i = 0; i < n; i++) {
        total += arena_footprint(arrays[i].bytes);
        if (!arena)
            continue;
        void *block = arena_alloc(arena, arrays[i].bytes);
        if (!block)
            return 0;
        memcpy(arrays[i].slot, &block, sizeof block);
    }
    return total;
}

#define TAKE(arrays, arena) take(arrays, sizeof(arrays) / sizeof((arrays)[0]), arena)
#define SLOT(field) ((void *)&m->field)

static size_t take_experts(struct imle *m, struct arena *arena)
{
    size_t n = (size_t)m->config.capacity;
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct array arrays[] = {
        {SLOT(strengths), n * sizeof *m->strengths},
        {SLOT(gate), n * sizeof *m->gate},
        {SLOT(nu), numbers(n * d)},
        {SLOT(root), numbers(n * triangle_size(m->d))},
        {SLOT(precision), numbers(n * d)},
        {SLOT(nu0), numbers(n * d)},
        {SLOT(sigma_birth), numbers(n * d)},
        {SLOT(spread), numbers(n * triangle_size(m->d))},
        {SLOT(phibar), numbers(n * p)},
        {SLOT(xbar), numbers(n * D)},
        {SLOT(W), numbers(n * p * D)},
        {SLOT(factor), numbers(n * triangle_size(m->p))},
        {SLOT(ridge), numbers(n * p)},
        {SLOT(ssr), numbers(n * D)},
        {SLOT(psi), numbers(n * D)},
    };

    return TAKE(arrays, arena);
}

static size_t take_shared(struct imle *m, struct arena *arena)
{
    size_t n = (size_t)m->config.capacity;
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct array arrays[] = {
        {SLOT(sigma_bar), numbers(d)},
        {SLOT(psi_bar), numbers(D)},
        {SLOT(phi), numbers(p)},
        {SLOT(dphi), numbers(p * d)},
        {SLOT(offset), numbers(p)},
        {SLOT(gain), numbers(p)},
        {SLOT(log_t), numbers(n)},
        {SLOT(log_h), numbers(n)},
        {SLOT(q), numbers(n)},
        {SLOT(slope), numbers(d * D)},
        {SLOT(order), n * sizeof *m->order},
        {SLOT(answers), n * sizeof *m->answers},
    };

    return TAKE(arrays, arena);
}

size_t imle_layout(struct imle *m, struct arena *arena)
{
    size_t experts = take_experts(m, arena);
    size_t shared = take_shared(m, arena);

    return experts > 0 && shared > 0 ? experts + shared : 0;
}

bool imle_state_part(const struct imle *m, int expert, int k, struct imle_part *part)
{
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct imle_part parts[] = {
        {m->nu, d, 0, false},         {m->nu0, d, 0, false},
        {m->sigma_birth, d, 0, true}, {m->spread, triangle_size(m->d), m->d, false},
        {m->phibar, p, 0, false},     {m->xbar, D, 0, false},
        {m->W, p * D, 0, false},      {m->factor, triangle_size(m->p), m->p, false},
        {m->ridge, p, 0, true},       {m->ssr, D, 0, false},
        {m->psi, D, 0, true},
    };

    if (k >= (int)(sizeof parts / sizeof parts[0]))
        return false;
    *part = parts[k];
    part->begin += (size_t)expert * part->size;
    return true;
}
