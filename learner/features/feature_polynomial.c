/* Monomials up to a degree under a Gaussian envelope: the leading terms of the Gaussian kernel
 * (docs/learner.md). Each is built from a parent by one multiplication. With a_i the power of input
 * i, d phi_a / d u_i = sqrt(a_i) phi_{a - e_i} - u_i phi_a, and phi_{a - e_i} is another monomial
 * of the same list. */
#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/features/feature_map_private.h"

enum { NOTHING = -1 };

/* Binomial(n_inputs + degree, degree), or 0 when that is over FEATURE_MAP_MAX. */
static int polynomial_count(int n_inputs, int degree)
{
    long count = 1;

    for (int k = 1; k <= degree; k++) {
        count = count * (n_inputs + k) / k;
        if (count > FEATURE_MAP_MAX)
            return 0;
    }
    return (int)count;
}

static size_t monomials_bytes(int n_features)
{
    return (size_t)n_features * sizeof(struct monomial);
}

static size_t lowered_bytes(int n_features, int n_inputs)
{
    return (size_t)n_features * (size_t)n_inputs * sizeof(struct lowered_monomial);
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

    for (; k > 0; k = map->monomials[k].parent)
        power += map->monomials[k].variable == i;
    return power;
}

/* All monomials, order by order, the constant first. A monomial is multiplied only by its last
 * input or a later one, so that each product comes once. */
static void build_monomials(struct feature_map *map)
{
    int order_begin = 0; /* the order before begins here, and ends at n */
    int n = 1;

    map->monomials[0] = (struct monomial){NOTHING, NOTHING, 1.0};
    for (int order = 1; order <= map->degree; order++) {
        int order_end = n;
        for (int parent = order_begin; parent < order_end; parent++) {
            int first = parent == 0 ? 0 : map->monomials[parent].variable;
            for (int i = first; i < map->n_inputs; i++) {
                double power = 1 + power_of(map, parent, i);
                map->monomials[n++] =
                    (struct monomial){(int16_t)parent, (int16_t)i, 1.0 / sqrt(power)};
            }
        }
        order_begin = order_end;
    }
}

/* The monomial `parent` times input i, known to exist. */
static int product_of(const struct feature_map *map, int parent, int i)
{
    int k = 1;

    while (map->monomials[k].parent != parent || map->monomials[k].variable != i)
        k++;
    return k;
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
            if (k > 0 && monomial->variable == i)
                below = monomial->parent;
            else if (k > 0)
                below = map->lowered[monomial->parent * d + i].index;
            if (monomial->variable != i && below != NOTHING)
                below = product_of(map, below, monomial->variable);
            map->lowered[k * d + i] =
                (struct lowered_monomial){below, sqrt((double)power_of(map, k, i))};
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
    double square = 0.0;

    for (int i = 0; i < map->n_inputs; i++)
        square += u[i] * u[i];
    phi[0] = elementary_exp(-0.5 * square);
    for (int k = 1; k < map->n_features; k++) {
        const struct monomial *monomial = &map->monomials[k];
        phi[k] = phi[monomial->parent] * u[monomial->variable] * monomial->factor;
    }
}

static void polynomial_derivative(const struct feature_map *map, const double *u, const double *phi,
                                  double *dphi)
{
    int d = map->n_inputs;

    for (int i = 0; i < d; i++)
        for (int k = 0; k < map->n_features; k++) {
            const struct lowered_monomial *lowered = &map->lowered[k * d + i];
            double below = lowered->index == NOTHING ? 0.0 : phi[lowered->index];
            dphi[i * map->n_features + k] = lowered->root * below - u[i] * phi[k];
        }
}

const struct feature_map_ops feature_map_polynomial = {
    .count = polynomial_count,
    .memory = polynomial_memory,
    .prepare = polynomial_prepare,
    .evaluate = polynomial_evaluate,
    .derivative = polynomial_derivative,
};
