#include "bed.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ARENAS = 64 };

static uint64_t state;
static struct arena *arenas[MOST_ARENAS];
static int n_arenas;

void bed_seed(void)
{
    const char *text = getenv("REACH_TEST_SEED");

    state = text ? strtoull(text, NULL, 10) : 1;
    printf("REACH_TEST_SEED=%llu\n", (unsigned long long)state);
    fflush(stdout);
}

/* splitmix64 */
static uint64_t next(void)
{
    state += 0x9E3779B97F4A7C15ULL;
    uint64_t mixed = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
    return mixed ^ (mixed >> 31);
}

double bed_uniform(double low, double high)
{
    return low + (high - low) * (double)(next() >> 11) * 0x1p-53;
}

double bed_normal(void)
{
    double radius = sqrt(-2.0 * log(1.0 - bed_uniform(0.0, 1.0)));

    return radius * cos(bed_uniform(0.0, 2.0 * 3.14159265358979323846));
}

struct learner *bed_create(const struct learner_config *config)
{
    char err[160] = "";
    size_t bytes = learner_memory(config);
    struct arena *arena = arena_create(bytes);

    ck_assert_ptr_nonnull(arena);
    ck_assert_int_lt(n_arenas, MOST_ARENAS);
    arenas[n_arenas++] = arena;
    struct learner *learner = learner_create(config, arena, err, sizeof err);
    ck_assert_msg(learner != NULL, "%s", err);
    ck_assert_uint_eq(arena_used(arena), bytes);
    return learner;
}

unsigned char *bed_saved(const struct learner *learner, size_t *size)
{
    *size = learner_save_size(learner);
    unsigned char *buffer = malloc(*size);

    ck_assert_ptr_nonnull(buffer);
    ck_assert_uint_eq(learner_save(learner, buffer, *size - 1), 0);
    ck_assert_uint_eq(learner_save(learner, buffer, *size), *size);
    return buffer;
}

void bed_expect_same_state(const struct learner *one, const struct learner *other)
{
    size_t n = 0;
    size_t m = 0;
    unsigned char *first = bed_saved(one, &n);
    unsigned char *second = bed_saved(other, &m);

    ck_assert_uint_eq(n, m);
    ck_assert_int_eq(memcmp(first, second, n), 0);
    free(first);
    free(second);
}

double bed_square_off(struct learner *learner, const double *z, const double *x, int n_outputs)
{
    static struct learner_prediction prediction;
    double least = INFINITY;

    learner_predict(learner, z, &prediction);
    for (int k = 0; k < prediction.n_solutions; k++) {
        double square = 0.0;
        for (int i = 0; i < n_outputs; i++)
            square += pow(prediction.solution[k].value[i] - x[i], 2.0);
        least = fmin(least, square);
    }
    return least;
}

void bed_clean(void)
{
    while (n_arenas > 0)
        arena_destroy(arenas[--n_arenas]);
}
