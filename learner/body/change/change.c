#include "learner/body/change/change.h"

#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/chain/vec3.h"
#include "learner/imle/whitener.h"

/* Samples come one after another along a motion, and what a body does not quite explain is much the
 * same for all of a moment: so many of them count as one. */
static const double alike = 10.0;

/* What may change, standard deviations: a zero or a direction by some degrees, lengths by a share
 * of the body's, the disparity by a share of its range. */
static const double zero_unit = 0.03;
static const double share_unit = 0.1;
static const double tilt_unit = 0.03;
static const double disparity_unit = 0.3;

enum { TILT = 6 }; /* in eyes_view's unknowns */

int change_columns(int n_joints)
{
    return n_joints + CHANGE_VIEW + CHANGE_TIP;
}

size_t change_sums_numbers(int n_joints)
{
    int m = change_columns(n_joints);

    return whitener_row(m) + (size_t)m;
}

void change_place(struct change_sums *sums, int n_joints, double *numbers)
{
    sums->C = numbers;
    sums->b = numbers + whitener_row(change_columns(n_joints));
}

void change_clear(struct change_sums *sums, int n_joints)
{
    sums->weight = sums->squares = 0.0;
    memset(sums->C, 0, change_sums_numbers(n_joints) * sizeof *sums->C);
}

double change_unit(const struct body *body, int column)
{
    int n = body->chain.n;

    if (column < n)
        return body->chain.slides[column] ? share_unit * body->length : zero_unit;
    if (column >= n + CHANGE_VIEW || !body->sees)
        return share_unit * body->length;
    return column == n + 2 ? disparity_unit * body->eyes.disparity_unit : tilt_unit;
}

/* Columns of the view: where eyes see a place that has not moved, once they are turned; or a base
 * that is elsewhere. */
static bool view_columns(const struct body *body, const double *x, double *by_view)
{
    struct eyes_view view;

    if (!body->sees) {
        for (int i = 0; i < 9; i++)
            by_view[i] = i % 4 == 0 ? 1.0 : 0.0;
        return true;
    }
    if (!eyes_point(&body->eyes, x, &view))
        return false;
    for (int r = 0; r < 3; r++) {
        by_view[3 * r] = -view.by_unknown[r * EYES_UNKNOWNS + TILT];
        by_view[3 * r + 1] = -view.by_unknown[r * EYES_UNKNOWNS + TILT + 1];
        by_view[3 * r + 2] = view.by_x[3 * r + 2];
    }
    return true;
}

bool change_rows(const struct body *body, const struct chain_pose *pose, const double *place,
                 const double *x, const double *white, double *rows)
{
    int n = body->chain.n;
    int m = change_columns(n);
    double by_zero[3 * CHAIN_MAX_JOINTS];
    double by_view[9];

    if (!view_columns(body, x, by_view))
        return false;
    chain_jacobian(&body->chain, pose, place, by_zero);
    for (int k = 0; k < m; k++) {
        double column[3];
        double unit = change_unit(body, k);
        for (int r = 0; r < 3; r++)
            column[r] = unit * (k < n                 ? by_zero[r * n + k]
                                : k < n + CHANGE_VIEW ? by_view[3 * r + k - n]
                                                      : pose->turn[n][3 * r + k - n - CHANGE_VIEW]);
        for (int r = 0; r < 3; r++)
            rows[r * m + k] = vec3_dot(white + (ptrdiff_t)3 * r, column);
    }
    return true;
}

void change_add(struct change_sums *sums, int n_joints, const double *rows, const double *y,
                double variance, double keep)
{
    int m = change_columns(n_joints);
    double share = 1.0 / variance;

    sums->weight = keep * sums->weight + 1.0;
    sums->squares = keep * sums->squares + share * vec3_dot(y, y);
    for (int i = 0; i < m; i++) {
        double *row = sums->C + whitener_row(i);
        for (int k = 0; k <= i; k++)
            row[k] = keep * row[k] + share * (rows[i] * rows[k] + rows[m + i] * rows[m + k] +
                                              rows[2 * m + i] * rows[2 * m + k]);
        sums->b[i] = keep * sums->b[i] +
                     share * (rows[i] * y[0] + rows[m + i] * y[1] + rows[2 * m + i] * y[2]);
    }
}

void change_fade(struct change_sums *sums, int n_joints, double keep)
{
    size_t numbers = change_sums_numbers(n_joints);

    sums->weight *= keep;
    sums->squares *= keep;
    for (size_t i = 0; i < numbers; i++) /* b lies behind C */
        sums->C[i] *= keep;
}

static double entry(const struct change_sums *sums, int i, int k)
{
    return i >= k ? sums->C[whitener_row(i) + (size_t)k] : sums->C[whitener_row(k) + (size_t)i];
}

/* C of the tip's columns, with its prior's precision. */
static void tip_block(const struct change_sums *sums, int n_joints, double precision, double *C)
{
    int tip = n_joints + CHANGE_VIEW;

    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            C[3 * i + k] = entry(sums, tip + i, tip + k) + (i == k ? precision : 0.0);
}

/* Columns of a cause: `count` of them from `first` on. */
static int columns_of(int n_joints, int cause, int *count)
{
    *count = cause < 0 ? 0 : cause < n_joints ? 1 : CHANGE_VIEW;
    return cause < 0 ? 0 : cause;
}

/* C and b of a cause's columns, 3 x 3 with zeros where there are fewer; where the tip may have
 * moved, with that eliminated. Returns the log of what the tip alone explains. */
static double reduce(const struct change_case *one, double share, int n_joints, int cause,
                     double *C, double *b)
{
    int count;
    int first = columns_of(n_joints, cause, &count);
    int tip = n_joints + CHANGE_VIEW;
    double across[9] = {0};
    double of_tip[9];
    double inverse[9];
    double by_tip[3];
    double pulled[3];
    double gain = 0.0;

    memset(C, 0, 9 * sizeof *C);
    memset(b, 0, 3 * sizeof *b);
    for (int i = 0; i < count; i++) {
        b[i] = share * one->sums->b[first + i];
        for (int k = 0; k < count; k++)
            C[3 * i + k] = share * entry(one->sums, first + i, first + k);
        for (int k = 0; k < 3; k++)
            across[3 * i + k] = share * entry(one->sums, first + i, tip + k);
    }
    if (one->moved <= 0.0)
        return 0.0;
    double prior = 1.0 / (one->moved * one->moved);
    tip_block(one->sums, n_joints, prior / share, of_tip);
    for (int i = 0; i < 9; i++)
        of_tip[i] *= share;
    for (int i = 0; i < 3; i++)
        by_tip[i] = share * one->sums->b[tip + i];
    gain = -0.5 * elementary_log(mat3_invert(of_tip, inverse) / (prior * prior * prior));
    mat3_apply(inverse, by_tip, pulled);
    gain += 0.5 * vec3_dot(by_tip, pulled);
    for (int i = 0; i < count; i++) {
        double back[3];
        mat3_apply(inverse, across + (ptrdiff_t)3 * i, back);
        for (int k = 0; k < count; k++)
            C[3 * i + k] -= vec3_dot(back, across + (ptrdiff_t)3 * k);
        b[i] -= vec3_dot(across + (ptrdiff_t)3 * i, pulled);
    }
    return gain;
}

void change_explain(const struct change_case *cases, int n_cases, int n_joints, int cause,
                    struct change_story *story)
{
    double A[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double inverse[9];
    double v[3] = {0};
    double C[9];
    double b[3];

    *story = (struct change_story){.cause = cause};
    for (int k = 0; k < n_cases; k++) {
        story->gain += reduce(&cases[k], 1.0 / alike, n_joints, cause, C, b);
        for (int i = 0; i < 9; i++)
            A[i] += C[i];
        vec3_add(1.0, b, v);
    }
    story->gain -= 0.5 * elementary_log(mat3_invert(A, inverse));
    mat3_apply(inverse, v, story->c);
    story->gain += 0.5 * vec3_dot(v, story->c);
}

static double rms_of(double squares, const struct change_sums *sums)
{
    return sqrt(fmax(squares, 0.0) / (3.0 * fmax(sums->weight, 1.0)));
}

double change_effect(const struct change_case *one, int n_joints, const struct change_story *story)
{
    double C[9];
    double b[3];
    double by[3];

    reduce(one, 1.0, n_joints, story->cause, C, b);
    mat3_apply(C, story->c, by);
    return rms_of(vec3_dot(story->c, by), one->sums);
}

/* Of the squares: b' C^-1 b of the tip's columns. */
static double taken_by_tip(const struct change_case *one, int n_joints)
{
    int tip = n_joints + CHANGE_VIEW;
    double of_tip[9];
    double inverse[9];
    double pulled[3];

    tip_block(one->sums, n_joints, 1.0 / (one->moved * one->moved), of_tip);
    mat3_invert(of_tip, inverse);
    mat3_apply(inverse, one->sums->b + tip, pulled);
    return vec3_dot(one->sums->b + tip, pulled);
}

double change_left(const struct change_case *one, int n_joints, const struct change_story *story)
{
    double C[9];
    double b[3];
    double by[3];

    /* The tip takes its share first, the story has what that leaves. */
    double taken = 0.0;
    if (one->moved > 0.0)
        taken = taken_by_tip(one, n_joints);
    reduce(one, 1.0, n_joints, story->cause, C, b);
    mat3_apply(C, story->c, by);
    return rms_of(one->sums->squares - taken - 2.0 * vec3_dot(story->c, b) + vec3_dot(story->c, by),
                  one->sums);
}

double change_of_tip(const struct change_sums *sums, int n_joints, double *moved)
{
    double C[9];
    double with_prior[9];
    double inverse[9];
    double by[3];

    tip_block(sums, n_joints, 0.0, C);
    tip_block(sums, n_joints, 1.0, with_prior);
    mat3_invert(with_prior, inverse);
    mat3_apply(inverse, sums->b + n_joints + CHANGE_VIEW, moved);
    mat3_apply(C, moved, by);
    return rms_of(vec3_dot(moved, by), sums);
}

/* By how much column `first + k` changes. */
static double by_how_much(const struct change_story *story, const struct body *body, int k)
{
    return story->c[k] * change_unit(body, story->cause + k);
}

void change_apply(const struct change_story *story, struct body *body)
{
    if (story->cause < body->chain.n) {
        body->chain.middle[story->cause] -= by_how_much(story, body, 0);
    } else if (body->sees) {
        body->eyes.tilt[0] += by_how_much(story, body, 0);
        body->eyes.tilt[1] += by_how_much(story, body, 1);
        body->eyes.disparity_middle += by_how_much(story, body, 2);
    } else {
        for (int k = 0; k < 3; k++)
            body->chain.offset[0][k] += by_how_much(story, body, k);
    }
}

void change_sample(const struct change_story *story, const struct body *before, double *z,
                   double *x)
{
    double by_view[9];
    double inverse[9];
    double moved[3] = {0};
    struct eyes_view view;

    if (story->cause < before->chain.n) {
        z[story->cause] -= by_how_much(story, before, 0);
        return;
    }
    if (!view_columns(before, x, by_view))
        return;
    for (int k = 0; k < 3; k++)
        for (int r = 0; r < 3; r++)
            moved[r] += by_view[3 * r + k] * by_how_much(story, before, k);
    if (!before->sees) {
        vec3_add(1.0, moved, x);
        return;
    }
    double step[3];
    eyes_point(&before->eyes, x, &view);
    mat3_invert(view.by_x, inverse);
    mat3_apply(inverse, moved, step);
    vec3_add(1.0, step, x);
}
