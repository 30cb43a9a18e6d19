/* Where everything of the mixture lies in memory, and which of it is state. */
#include <string.h>

#include "learner/imle/imle.h"

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
        {SLOT(nu), numbers(n * d)},
        {SLOT(precision), numbers(n * d)},
        {SLOT(nu0), numbers(n * d)},
        {SLOT(sigma_birth), numbers(n * d)},
        {SLOT(spread), numbers(n * whitener_row(m->d))},
        {SLOT(phibar), numbers(n * p)},
        {SLOT(xbar), numbers(n * D)},
        {SLOT(W), numbers(n * p * D)},
        {SLOT(whitener), numbers(n * whitener_row(m->p))},
        {SLOT(ridge), numbers(n * p)},
        {SLOT(ssr), numbers(n * D)},
        {SLOT(psi), numbers(n * D)},
    };

    return TAKE(arrays, arena);
}

static size_t take_scan(struct imle *m, struct arena *arena)
{
    size_t n = imle_lanes_experts(&m->config);
    const struct array arrays[] = {
        {SLOT(lanes), numbers(n / KERNEL_LANES * imle_lanes_block(m->d))},
        {SLOT(gate.log_det), numbers(n)},
        {SLOT(gate.log_norm), numbers(n)},
        {SLOT(gate.exponent), numbers(n)},
        {SLOT(gate.per_a), numbers(n)},
        {SLOT(gate.half_log_psi), numbers(n)},
        {SLOT(gate.log_S), numbers(n)},
        {SLOT(log_t), numbers(n)},
        {SLOT(log_h), numbers(n)},
        {SLOT(q), numbers(n)},
        {SLOT(gate.log_peak), numbers(n)},
        {SLOT(answered), n / KERNEL_LANES + 1},
        {SLOT(levered), n / KERNEL_LANES + 1},
        {SLOT(leverages), numbers(n)},
        {SLOT(misfits), numbers(n)},
        {SLOT(outputs), numbers(n * (size_t)m->D)},
        {SLOT(prior_sums), numbers((n / IMLE_SUM + 1) * (size_t)(m->d + m->D))},
        {SLOT(stale), n / IMLE_SUM + 1},
        {SLOT(regression),
         m->small ? numbers(n / KERNEL_LANES * imle_regression_block(m->p, m->D)) : 0},
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
        {SLOT(white), numbers(p)},
        {SLOT(gain), numbers(p)},
        {SLOT(add.keep), numbers(p)},
        {SLOT(add.take), numbers(p)},
        {SLOT(add.grow), numbers(p)},
        {SLOT(add.sum), numbers(p)},
        {SLOT(slope), numbers(d * D)},
        {SLOT(order), n * sizeof *m->order},
        {SLOT(answers), IMLE_MOST_ANSWERS * sizeof *m->answers},
        {SLOT(split), imle_split_memory()},
    };

    return TAKE(arrays, arena);
}

size_t imle_layout(struct imle *m, struct arena *arena)
{
    size_t experts = take_experts(m, arena);
    size_t scan = take_scan(m, arena);
    size_t shared = take_shared(m, arena);

    return experts > 0 && scan > 0 && shared > 0 ? experts + scan + shared : 0;
}

bool imle_state_part(const struct imle *m, int expert, int k, struct imle_part *part)
{
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct imle_part parts[] = {
        {m->nu, d, 0, false},         {m->nu0, d, 0, false},
        {m->sigma_birth, d, 0, true}, {m->spread, whitener_row(m->d), m->d, false},
        {m->phibar, p, 0, false},     {m->xbar, D, 0, false},
        {m->W, p * D, 0, false},      {m->whitener, whitener_row(m->p), m->p, false},
        {m->ridge, p, 0, true},       {m->ssr, D, 0, false},
        {m->psi, D, 0, true},
    };

    if (k >= (int)(sizeof parts / sizeof parts[0]))
        return false;
    *part = parts[k];
    part->begin += (size_t)expert * part->size;
    return true;
}
