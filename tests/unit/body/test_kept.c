/* Samples that are kept: spread, as many as there is room for, of today, and the same each time. */
#include "learner/body/tool/kept.h"

#include <math.h>
#include <string.h>

#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

enum { INPUTS = 3, OUTPUTS = 2, CAPACITY = 64, NUMBERS = CAPACITY * (INPUTS + OUTPUTS + 1) };

static double room[2][NUMBERS];

static struct kept kept_in(int k)
{
    struct kept kept;

    ck_assert_uint_eq(kept_numbers(CAPACITY, INPUTS, OUTPUTS), NUMBERS);
    memset(room[k], 0, sizeof room[k]);
    kept_place(&kept, CAPACITY, INPUTS, OUTPUTS, room[k]);
    return kept;
}

static double apart(const double *a, const double *b)
{
    double most = 0.0;

    for (int i = 0; i < INPUTS; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

static void random_input(double range, double *z)
{
    for (int i = 0; i < INPUTS; i++)
        z[i] = bed_uniform(-range, range);
}

/* Nobody is nearer to another than the spacing was when the first of them came. */
static void expect_spread(const struct kept *kept, double spacing)
{
    for (int i = 0; i < kept->n; i++)
        for (int j = 0; j < i; j++)
            ck_assert_double_ge(apart(kept->z + i * INPUTS, kept->z + j * INPUTS), spacing);
}

START_TEST(samples_are_spread)
{
    struct kept kept = kept_in(0);
    double first = kept.spacing;

    bed_seed();
    for (int k = 0; k < 20000; k++) { /* a small room: most are near another, many old */
        double z[INPUTS], x[OUTPUTS] = {k, -k};
        random_input(0.015, z);
        kept_add(&kept, z, x);
        ck_assert_int_le(kept.n, CAPACITY);
        ck_assert(kept.n < CAPACITY || k >= CAPACITY);
        if (k % 100 == 0)
            expect_spread(&kept, first);
    }
    ck_assert_int_gt(kept.n, 8);
    expect_spread(&kept, first);
}
END_TEST

START_TEST(there_are_never_more_than_fit)
{
    struct kept kept = kept_in(0);
    double z[INPUTS], x[OUTPUTS] = {1.0, 2.0};

    bed_seed();
    for (int k = 0; k < 100000; k++) {
        random_input(3.0, z);
        kept_add(&kept, z, x);
        ck_assert_int_eq(kept.n, k < CAPACITY ? k + 1 : kept.n);
        ck_assert_int_le(kept.n, CAPACITY);
    }
    ck_assert_int_eq(kept.n, CAPACITY);
    ck_assert_double_le(kept.spacing, 0.2);
    ck_assert_double_eq(kept.offered, 100000.0);
}
END_TEST

/* The robot's answers move; what is kept follows. */
START_TEST(old_samples_give_way)
{
    struct kept kept = kept_in(0);
    double z[INPUTS];

    bed_seed();
    for (int k = 0; k < 6000; k++) {
        double x[OUTPUTS] = {k, k};
        random_input(0.05, z);
        kept_add(&kept, z, x);
    }
    for (int i = 0; i < kept.n; i++) {
        ck_assert_double_ge(kept.x[i * OUTPUTS], 3000.0);
        ck_assert_double_eq(kept.x[i * OUTPUTS] + 1.0, kept.at[i]);
    }
}
END_TEST

/* A young sample near it keeps a new one out; an old one gives it its place; where both are near,
 * the young one stays alone. */
START_TEST(who_is_near_decides)
{
    struct kept kept = kept_in(0);
    const double left[INPUTS] = {0.0}, right[INPUTS] = {0.015}, between[INPUTS] = {0.0075};
    const double far[INPUTS] = {1.0};
    double x[OUTPUTS] = {1.0, 1.0};

    kept_add(&kept, left, x);
    kept_add(&kept, between, x);
    ck_assert_int_eq(kept.n, 1);
    for (int k = 0; k < 1000; k++)
        kept_add(&kept, far, x);
    kept_add(&kept, right, x);
    ck_assert_int_eq(kept.n, 3);
    x[0] = 2.0;
    kept_add(&kept, between, x); /* `right` is young */
    ck_assert_int_eq(kept_nearest_output(&kept, x, (double[]){1.0, 1.0}), 0);
    for (int k = 0; k < 1000; k++)
        kept_add(&kept, far, x);
    kept_add(&kept, between, x); /* both are old, and go */
    ck_assert_int_eq(kept.n, 2);
    ck_assert_double_eq(kept.z[INPUTS * kept_nearest(&kept, left)], between[0]);
}
END_TEST

START_TEST(the_nearest_is_found)
{
    struct kept kept = kept_in(0);
    double z[INPUTS], x[OUTPUTS];
    const double unit[OUTPUTS] = {1.0, 10.0};

    bed_seed();
    ck_assert_int_eq(kept_nearest(&kept, room[1]), -1);
    ck_assert_int_eq(kept_nearest_output(&kept, room[1], unit), -1);
    for (int k = 0; k < CAPACITY; k++) {
        random_input(1.0, z);
        x[0] = bed_normal();
        x[1] = bed_normal();
        kept_add(&kept, z, x);
    }
    for (int k = 0; k < 100; k++) {
        int nearest = 0;
        int nearest_output = 0;
        random_input(1.0, z);
        x[0] = bed_normal();
        x[1] = bed_normal();
        for (int i = 1; i < kept.n; i++) {
            const double *best = kept.x + nearest_output * OUTPUTS, *one = kept.x + i * OUTPUTS;
            if (apart(kept.z + i * INPUTS, z) < apart(kept.z + nearest * INPUTS, z))
                nearest = i;
            if (hypot(one[0] - x[0], (one[1] - x[1]) / 10.0) <
                hypot(best[0] - x[0], (best[1] - x[1]) / 10.0))
                nearest_output = i;
        }
        ck_assert_int_eq(kept_nearest(&kept, z), nearest);
        ck_assert_int_eq(kept_nearest_output(&kept, x, unit), nearest_output);
    }
}
END_TEST

START_TEST(the_same_samples_keep_the_same)
{
    struct kept one = kept_in(0);
    struct kept other = kept_in(1);

    bed_seed();
    for (int k = 0; k < 5000; k++) {
        double z[INPUTS], x[OUTPUTS] = {bed_normal(), k};
        random_input(k % 2 ? 0.1 : 2.0, z);
        kept_add(&one, z, x);
        kept_add(&other, z, x);
    }
    ck_assert_int_eq(one.n, other.n);
    ck_assert_int_eq(memcmp(room[0], room[1], sizeof room[0]), 0);
    kept_clear(&one);
    ck_assert_int_eq(one.n, 0);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        samples_are_spread,  there_are_never_more_than_fit, old_samples_give_way,
        who_is_near_decides, the_nearest_is_found,          the_same_samples_keep_the_same,
    };

    return SUITE_RUN("kept", tests);
}
