#include "learner/body/chain/eyes.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/chain/vec3.h"

enum { NECK = 0, EYE = 3, TILT = 6, LAW = 8 };

/* Nearer to infinity than this, in the eyes' unit of 1 / length, nothing is seen. */
static const double least_inverse_depth = 1e-3;

struct turns {
    double yaw[9];   /* Rz */
    double both[9];  /* Rz Ry */
    double slope[9]; /* Rz dRy / dpitch */
};

static void turn_head(const struct eyes *eyes, const double *x, struct turns *turns)
{
    double sy;
    double cy;
    double sp;
    double cp;

    elementary_sin_cos(x[0] * eyes->angle_unit, &sy, &cy);
    elementary_sin_cos(x[1] * eyes->angle_unit, &sp, &cp);
    double Rz[9] = {cy, -sy, 0, sy, cy, 0, 0, 0, 1};
    double Ry[9] = {cp, 0, sp, 0, 1, 0, -sp, 0, cp};
    double dRy[9] = {-sp, 0, cp, 0, 0, 0, -cp, 0, -sp};
    memcpy(turns->yaw, Rz, sizeof Rz);
    mat3_multiply(Rz, Ry, turns->both);
    mat3_multiply(Rz, dRy, turns->slope);
}

static void put_column(double *matrix, int columns, int column, double factor, const double *v)
{
    for (int row = 0; row < 3; row++)
        matrix[row * columns + column] = factor * v[row];
}

/* By the unknowns: `gaze` is the optical axis in the base's frame, z the depth along it. */
static void by_unknowns(const struct eyes *eyes, const struct turns *turns, const double *a,
                        const double *gaze, double z, double d, double length,
                        struct eyes_view *view)
{
    for (int k = 0; k < 3; k++)
        for (int row = 0; row < 3; row++) {
            view->by_unknown[row * EYES_UNKNOWNS + NECK + k] = turns->yaw[3 * row + k];
            view->by_unknown[row * EYES_UNKNOWNS + EYE + k] = turns->both[3 * row + k];
        }
    for (int k = 0; k < 2; k++) {
        double turned[3];
        double by_tilt[3];
        for (int i = 0; i < 3; i++)
            by_tilt[i] = ((i == k + 1 ? 1.0 : 0.0) - a[i] * a[k + 1]) / length;
        mat3_apply(turns->both, by_tilt, turned);
        put_column(view->by_unknown, EYES_UNKNOWNS, TILT + k, z, turned);
    }
    put_column(view->by_unknown, EYES_UNKNOWNS, LAW, -z * z * d, gaze);
    put_column(view->by_unknown, EYES_UNKNOWNS, LAW + 1, -z * z * d * d, gaze);
    (void)eyes;
}

bool eyes_point(const struct eyes *eyes, const double *x, struct eyes_view *view)
{
    double d = (x[2] - eyes->disparity_middle) / eyes->disparity_unit;
    double inverse = eyes->law[0] + d * (eyes->law[1] + d * eyes->law[2]);
    double a[3] = {1.0, eyes->tilt[0], eyes->tilt[1]};
    double length = vec3_length(a);
    double inner[3];
    double gaze[3];
    double moved[3];
    struct turns turns;

    if (!(inverse > least_inverse_depth))
        return false;
    double z = 1.0 / inverse;
    turn_head(eyes, x, &turns);
    for (int i = 0; i < 3; i++) {
        a[i] /= length;
        inner[i] = eyes->eye[i] + z * a[i];
    }
    mat3_apply(turns.both, inner, view->point);
    mat3_apply(turns.yaw, eyes->neck, moved);
    vec3_add(1.0, moved, view->point);
    double by_yaw[3] = {-view->point[1], view->point[0], 0.0};
    put_column(view->by_x, 3, 0, eyes->angle_unit, by_yaw);
    mat3_apply(turns.slope, inner, moved);
    put_column(view->by_x, 3, 1, eyes->angle_unit, moved);
    mat3_apply(turns.both, a, gaze);
    put_column(view->by_x, 3, 2,
               -z * z * (eyes->law[1] + 2.0 * d * eyes->law[2]) / eyes->disparity_unit, gaze);
    by_unknowns(eyes, &turns, a, gaze, z, d, length, view);
    return true;
}

bool eyes_look_at(const struct eyes *eyes, const double *point, double *x)
{
    const double most[3] = {0.3 / eyes->angle_unit, 0.3 / eyes->angle_unit,
                            0.3 * eyes->disparity_unit};
    const double enough = 1e-12;
    enum { MOST_STEPS = 40 };
    struct eyes_view view;

    for (int step = 0; step < MOST_STEPS; step++) {
        double inverse[9];
        double left[3];
        double change[3];
        double largest = 0.0;
        double finite = 0.0;
        if (!eyes_point(eyes, x, &view))
            return false;
        for (int i = 0; i < 3; i++)
            left[i] = point[i] - view.point[i];
        mat3_invert(view.by_x, inverse);
        mat3_apply(inverse, left, change);
        for (int i = 0; i < 3; i++) {
            largest = fmax(largest, fabs(change[i]) / most[i]);
            finite += change[i]; /* fmax() leaves out what is no number */
        }
        if (!(fabs(finite) < 1e9 && largest < 1e9))
            return false;
        for (int i = 0; i < 3; i++)
            x[i] += change[i] / fmax(1.0, largest);
        if (largest < enough)
            return true;
    }
    return false;
}
