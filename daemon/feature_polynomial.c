/* Monomials up to a degree. Each is built from a parent by one multiplication, and its derivative
 * by an input is another monomial of the same list: d/du (u^a / a!) = u^(a-1) / (a-1)!. */
#include <string.h>

#include "daemon/feature_map_private.h"

enum { CONSTANT = -1, NOTHING = -2 };

/* Binomial(n_inputs + degree, degree) - 1, or 0 when that is over FEATURE_MAP_MAX. */
static int polynomial_count(int n_inputs, int degree)
{
    long count = 1;

    for (int k = 1; k <= degree; k++) {
        count = count * (n_inputs + k) / k;
        if (count - 1 > FEATURE_MAP_MAX)
            return 0;
    }
    return (int)(count - 1);
}

static size_t monomials_bytes(int n_features)
{
    return (size_t)n_features * sizeof(struct monomial);
}

static size_t lowered_bytes(int n_features, int n_inputs)
{
    return (size_t)n_features * (size_t)n_inputs * sizeof(int16_t);
}

static size_t polynomial_memory(int n_inputs, int degree)
{
    int n = polynomial_count(n_inputs, degree);

    return arena_footprint(monomials_bytes(n)) + arena_footprint(lowered_bytes(n, n_inputs));
}

/* Power of input i in monomial k: the number of steps on its way to the constant that multiply by
 * that input. */
static int power_of(const struct feature_map *map, int k, int i)
{
    int power = 0;

    for (; k != CONSTANT; k = map->monomials[k].parent)
        power += map->monomials[k].variable == i;
    return power;
}

/* All monomials, order by order. A monomial is multiplied only by its last input or a later one, so
 * that each product comes once. */
static void build_monomials(struct feature_map *map)
{
    int n = 0;
    int order_begin = CONSTANT; /* the order before begins here, and ends at n */

    for (int order = 1; order <= map->degree; order++) {
        int order_end = n;
        for (int parent = order_begin; parent < order_end; parent++) {
            int first = parent == CONSTANT ? 0 : map->monomials[parent].variable;
            for (int i = first; i < map->n_inputs; i++) {
                int power = 1 + (parent == CONSTANT ? 0 : power_of(map, parent, i));
                map->monomials[n++] =
                    (struct monomial){(int16_t)parent, (int16_t)i, 1.0 / (double)power};
            }
        }
        order_begin = order_end;
    }
}

/* The monomial `parent` times input i, known to exist. */
static int product_of(const struct feature_map *map, int parent, int i)
{
    for (int k = 0; k < map->n_features; k++)
        if (map->monomials[k].parent == parent && map->monomials[k].variable == i)
            return k;
    return NOTHING;
}

/* One power of input i less: the parent if that input came last, otherwise the same step taken from
 * the parent's own lowered monomial (which comes earlier in the list, so it is known). */
static void build_lowered(struct feature_map *map)
{
    int d = map->n_inputs;

    for (int k = 0; k < map->n_features; k++) {
        const struct monomial *monomial = &map->monomials[k];
        for (int i = 0; i < d; i++) {
            int below = NOTHING;
            if (monomial->variable == i)
                below = monomial->parent;
            else if (monomial->parent != CONSTANT)
                below = map->lowered[monomial->parent * d + i];
            if (monomial->variable != i && below != NOTHING)
                below = product_of(map, below, monomial->variable);
            map->lowered[k * d + i] = (int16_t)below;
        }
    }
}

static int polynomial_prepare(struct feature_map *map, struct arena *arena)
{
    map->monomials = arena_alloc(arena, monomials_bytes(map->n_features));
    map->lowered = arena_alloc(arena, lowered_bytes(map->n_features, map->n_inputs));
    if (!map->monomials || !map->lowered)
        return -1;
    build_monomials(map);
    build_lowered(map);
    return 0;
}

static void polynomial_evaluate(const struct feature_map *map, const double *u, double *phi)
{
    for (int k = 0; k < map->n_features; k++) {
        const struct monomial *monomial = &map->monomials[k];
        double parent = monomial->parent == CONSTANT ? 1.0 : phi[monomial->parent];
        phi[k] = parent * u[monomial->variable] * monomial->factor;
    }
}

static void polynomial_derivative(const struct feature_map *map, const double *phi, double *dphi)
{
    for (int k = 0; k < map->n_features * map->n_inputs; k++) {
        int below = map->lowered[k];
        if (below == NOTHING)
            dphi[k] = 0.0;
        else
            dphi[k] = below == CONSTANT ? 1.0 : phi[below];
    }
}

const struct feature_map_ops feature_map_polynomial = {
    .count = polynomial_count,
    .memory = polynomial_memory,
    .prepare = polynomial_prepare,
    .evaluate = polynomial_evaluate,
    .derivative = polynomial_derivative,
};
