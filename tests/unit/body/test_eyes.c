/* Eyes that fixate: derivatives against differences, looking as the inverse of seeing, and what
 * cannot be seen. */
#include "learner/body/chain/eyes.h"

#include <math.h>
#include <string.h>

#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

/* In radians, or in degrees. */
static struct eyes random_eyes(double angle_unit)
{
    struct eyes eyes = {.angle_unit = angle_unit,
                        .disparity_middle = bed_uniform(-20.0, 20.0),
                        .disparity_unit = bed_uniform(1.0, 30.0),
                        .law = {2.0, bed_uniform(0.2, 0.6), bed_uniform(-0.05, 0.05)}};

    for (int k = 0; k < 3; k++) {
        eyes.neck[k] = 0.1 * bed_normal();
        eyes.eye[k] = 0.05 * bed_normal();
    }
    for (int k = 0; k < 2; k++)
        eyes.tilt[k] = 0.2 * bed_normal();
    return eyes;
}

static void random_gaze(const struct eyes *eyes, double *x)
{
    x[0] = bed_uniform(-1.0, 1.0) / eyes->angle_unit;
    x[1] = bed_uniform(-0.8, 0.8) / eyes->angle_unit;
    x[2] = eyes->disparity_middle + bed_uniform(-1.0, 1.0) * eyes->disparity_unit;
}

static double *unknown(struct eyes *eyes, int k)
{
    if (k < 3)
        return &eyes->neck[k];
    if (k < 6)
        return &eyes->eye[k - 3];
    return k < 8 ? &eyes->tilt[k - 6] : &eyes->law[k - 7];
}

/* (P(b) - P(a)) / apart is the column of a matrix at the middle. */
static void expect_slope(const struct eyes_view *a, const struct eyes_view *b, double apart,
                         const double *matrix, int columns, int column)
{
    for (int row = 0; row < 3; row++)
        ck_assert_double_eq_tol(matrix[row * columns + column],
                                (b->point[row] - a->point[row]) / apart, 1e-7);
}

START_TEST(derivatives_are_those_of_the_point)
{
    bed_seed();
    for (int k = 0; k < 200; k++) {
        struct eyes eyes = random_eyes(k % 2 ? 1.0 : 3.14159265358979 / 180.0);
        struct eyes_view view, behind, ahead;
        double x[3];
        random_gaze(&eyes, x);
        ck_assert(eyes_point(&eyes, x, &view));
        for (int i = 0; i < 3; i++) {
            double step = 1e-5 * (i < 2 ? 1.0 / eyes.angle_unit : eyes.disparity_unit);
            double here = x[i];
            x[i] = here - step;
            ck_assert(eyes_point(&eyes, x, &behind));
            x[i] = here + step;
            ck_assert(eyes_point(&eyes, x, &ahead));
            x[i] = here;
            expect_slope(&behind, &ahead, 2.0 * step, view.by_x, 3, i);
        }
        for (int i = 0; i < EYES_UNKNOWNS; i++) {
            struct eyes other = eyes;
            *unknown(&other, i) -= 1e-5;
            ck_assert(eyes_point(&other, x, &behind));
            *unknown(&other, i) += 2e-5;
            ck_assert(eyes_point(&other, x, &ahead));
            expect_slope(&behind, &ahead, 2e-5, view.by_unknown, EYES_UNKNOWNS, i);
        }
    }
}
END_TEST

START_TEST(looking_inverts_seeing)
{
    int others = 0;

    bed_seed();
    for (int k = 0; k < 1000; k++) {
        struct eyes eyes = random_eyes(k % 2 ? 1.0 : 3.14159265358979 / 180.0);
        struct eyes_view view, again;
        double x[3];
        double looked[3];
        random_gaze(&eyes, x);
        ck_assert(eyes_point(&eyes, x, &view));
        memcpy(looked, x, sizeof x);
        looked[0] += bed_uniform(-0.3, 0.3) / eyes.angle_unit;
        looked[1] += bed_uniform(-0.3, 0.3) / eyes.angle_unit;
        looked[2] += bed_uniform(-0.3, 0.3) * eyes.disparity_unit;
        ck_assert(eyes_look_at(&eyes, view.point, looked));
        ck_assert(eyes_point(&eyes, looked, &again));
        for (int i = 0; i < 3; i++)
            ck_assert_double_eq_tol(again.point[i], view.point[i], 1e-10);
        others += fabs(looked[0] - x[0]) > 1e-9 / eyes.angle_unit;
    }
    /* A head can see some places in two ways: over its shoulder. */
    ck_assert_int_le(others, 5);
}
END_TEST

START_TEST(what_cannot_be_seen_is_refused)
{
    bed_seed();
    struct eyes eyes = random_eyes(1.0);
    struct eyes_view view;
    double far_off[3] = {0.0, 0.0, 0.0};
    double x[3];

    eyes.law[2] = 0.0;
    far_off[2] = eyes.disparity_middle - eyes.law[0] / eyes.law[1] * eyes.disparity_unit;
    ck_assert(!eyes_point(&eyes, far_off, &view)); /* infinitely far */
    far_off[2] -= eyes.disparity_unit;
    ck_assert(!eyes_point(&eyes, far_off, &view)); /* behind the eyes */
    far_off[2] = NAN;
    ck_assert(!eyes_point(&eyes, far_off, &view));

    double point[3] = {INFINITY, 0.0, 0.0};
    random_gaze(&eyes, x);
    ck_assert(!eyes_look_at(&eyes, point, x));
    point[0] = NAN;
    random_gaze(&eyes, x);
    ck_assert(!eyes_look_at(&eyes, point, x));
    point[0] = 5e3; /* farther than anything is seen */
    random_gaze(&eyes, x);
    ck_assert(!eyes_look_at(&eyes, point, x));
    point[0] = 1.0;
    x[2] = far_off[2]; /* begun at nothing */
    ck_assert(!eyes_look_at(&eyes, point, x));
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        derivatives_are_those_of_the_point,
        looking_inverts_seeing,
        what_cannot_be_seen_is_refused,
    };

    return SUITE_RUN("eyes", tests);
}
