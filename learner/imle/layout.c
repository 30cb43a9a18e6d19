/* Where everything of the mixture lies in memory, and which of it is saved. */
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
static size_t take_arrays(const struct array *arrays, size_t n, struct arena *arena)
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

#define TAKE(arrays, arena) take_arrays(arrays, sizeof(arrays) / sizeof((arrays)[0]), arena)
#define SLOT(field) ((void *)&m->field)

static size_t take_state(struct imle *m, struct arena *arena)
{
    size_t n = (size_t)m->config.capacity;
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct array arrays[] = {
        {SLOT(state.sigma_bar), numbers(d)},
        {SLOT(state.psi_bar), numbers(D)},
        {SLOT(state.seen), numbers(2 * D)},
        {SLOT(state.strengths), n * sizeof *m->state.strengths},
        {SLOT(state.nu), numbers(n * d)},
        {SLOT(state.nu0), numbers(n * d)},
        {SLOT(state.sigma_birth), numbers(n * d)},
        {SLOT(state.spread), numbers(n * whitener_row(m->d))},
        {SLOT(state.phibar), numbers(n * p)},
        {SLOT(state.xbar), numbers(n * D)},
        {SLOT(state.W), numbers(n * p * D)},
        {SLOT(state.whitener), numbers(n * whitener_row(m->p))},
        {SLOT(state.ridge), numbers(n * p)},
        {SLOT(state.ssr), numbers(n * D)},
        {SLOT(state.psi), numbers(n * D)},
        {SLOT(state.typical), numbers(n * D)},
        {SLOT(state.remembered), numbers(n * IMLE_REMEMBERED * (d + D))},
        {SLOT(state.residual), numbers(n * D)},
    };

    return TAKE(arrays, arena);
}

static size_t take_derived(struct imle *m, struct arena *arena)
{
    size_t n = imle_lanes_experts(&m->config);
    size_t regression = m->small ? n / KERNEL_LANES * imle_regression_block(m->p, m->D) : 0;
    const struct array arrays[] = {
        {SLOT(derived.lanes), numbers(n / KERNEL_LANES * imle_lanes_block(m->d))},
        {SLOT(derived.gate.log_det), numbers(n)},
        {SLOT(derived.gate.log_norm), numbers(n)},
        {SLOT(derived.gate.exponent), numbers(n)},
        {SLOT(derived.gate.per_a), numbers(n)},
        {SLOT(derived.gate.half_log_psi), numbers(n)},
        {SLOT(derived.gate.log_S), numbers(n)},
        {SLOT(derived.gate.log_peak), numbers(n)},
        {SLOT(derived.precision), numbers((size_t)m->config.capacity * (size_t)m->d)},
        {SLOT(derived.regression), numbers(regression)},
        {SLOT(derived.prior_sums), numbers((n / IMLE_SUM + 1) * (size_t)(m->d + m->D))},
        {SLOT(derived.stale), n / IMLE_SUM + 1},
    };

    return TAKE(arrays, arena);
}

static size_t take_query(struct imle *m, struct arena *arena)
{
    size_t n = imle_lanes_experts(&m->config);
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct array arrays[] = {
        {SLOT(query.phi), numbers(p)},
        {SLOT(query.dphi), numbers(p * d)},
        {SLOT(query.q), numbers(n)},
        {SLOT(query.log_t), numbers(n)},
        {SLOT(query.log_h), numbers(n)}, /* and all that share its memory */
        {SLOT(query.order), (size_t)m->config.capacity * sizeof *m->query.order},
        {SLOT(query.offset), numbers(p)},
        {SLOT(query.white), numbers(p)},
        {SLOT(query.gain), numbers(p)},
        {SLOT(query.slope), numbers(d * D)},
        {SLOT(query.add.keep), numbers(p)},
        {SLOT(query.add.take), numbers(p)},
        {SLOT(query.add.grow), numbers(p)},
        {SLOT(query.add.sum), numbers(p)},
        {SLOT(query.answered), n / KERNEL_LANES + 1},
        {SLOT(query.levered), n / KERNEL_LANES + 1},
        {SLOT(query.leverages), numbers(n)},
        {SLOT(query.misfits), numbers(n)},
        {SLOT(query.outputs), numbers(n * D)},
        {SLOT(query.answers), IMLE_MOST_ANSWERS * sizeof *m->query.answers},
        {SLOT(query.split), imle_split_memory()},
    };

    return TAKE(arrays, arena);
}

size_t imle_layout(struct imle *m, struct arena *arena)
{
    size_t state = take_state(m, arena);
    size_t derived = take_derived(m, arena);
    size_t query = take_query(m, arena);

    return state > 0 && derived > 0 && query > 0 ? state + derived + query : 0;
}

bool imle_state_part(const struct imle *m, int expert, int k, struct imle_part *part)
{
    size_t d = (size_t)m->d;
    size_t D = (size_t)m->D;
    size_t p = (size_t)m->p;
    const struct imle_part parts[] = {
        {m->state.nu, d, 0, false},
        {m->state.nu0, d, 0, false},
        {m->state.sigma_birth, d, 0, true},
        {m->state.spread, whitener_row(m->d), m->d, false},
        {m->state.phibar, p, 0, false},
        {m->state.xbar, D, 0, false},
        {m->state.W, p * D, 0, false},
        {m->state.whitener, whitener_row(m->p), m->p, false},
        {m->state.ridge, p, 0, true},
        {m->state.ssr, D, 0, false},
        {m->state.psi, D, 0, true},
        {m->state.typical, D, 0, false},
        {m->state.residual, D, 0, false},
        {m->state.remembered, IMLE_REMEMBERED * (d + D), 0, false},
    };

    if (k >= (int)(sizeof parts / sizeof parts[0]))
        return false;
    *part = parts[k];
    part->begin += (size_t)expert * part->size;
    return true;
}
