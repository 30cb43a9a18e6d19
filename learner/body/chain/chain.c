#include "learner/body/chain/chain.h"

#include <stddef.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/chain/vec3.h"

/* Rodrigues: the turn by `angle` about a unit vector. */
static void turn_about(const double *w, double angle, double *E)
{
    double s;
    double c;

    elementary_sin_cos(angle, &s, &c);
    double v = 1.0 - c;
    E[0] = c + v * w[0] * w[0];
    E[4] = c + v * w[1] * w[1];
    E[8] = c + v * w[2] * w[2];
    E[1] = v * w[0] * w[1] - s * w[2];
    E[3] = v * w[0] * w[1] + s * w[2];
    E[2] = v * w[0] * w[2] + s * w[1];
    E[6] = v * w[0] * w[2] - s * w[1];
    E[5] = v * w[1] * w[2] - s * w[0];
    E[7] = v * w[1] * w[2] + s * w[0];
}

void chain_at(const struct chain *chain, const double *q, struct chain_pose *pose)
{
    static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double here[3] = {0, 0, 0};

    memcpy(pose->turn[0], unit, sizeof unit);
    for (int i = 0; i < chain->n; i++) {
        double E[9];
        double step[3];
        pose->moved[i] = q[i] - chain->middle[i];
        mat3_apply(pose->turn[i], chain->offset[i], step);
        vec3_add(1.0, step, here);
        memcpy(pose->place[i], here, sizeof here);
        mat3_apply(pose->turn[i], chain->axis[i], pose->axis[i]);
        if (chain->slides[i]) {
            vec3_add(pose->moved[i], pose->axis[i], here);
            memcpy(pose->turn[i + 1], pose->turn[i], sizeof pose->turn[i]);
            continue;
        }
        turn_about(chain->axis[i], pose->moved[i], E);
        mat3_multiply(pose->turn[i], E, pose->turn[i + 1]);
    }
    memcpy(pose->p, here, sizeof here);
}

/* How the tip moves with joint i. */
static void motion_of(const struct chain *chain, const struct chain_pose *pose, int i,
                      const double *tip, double *motion)
{
    double lever[3];

    if (chain->slides[i]) {
        memcpy(motion, pose->axis[i], sizeof lever);
        return;
    }
    memcpy(lever, tip, sizeof lever);
    vec3_add(-1.0, pose->place[i], lever);
    vec3_cross(pose->axis[i], lever, motion);
}

void chain_jacobian(const struct chain *chain, const struct chain_pose *pose, const double *tip,
                    double *jacobian)
{
    for (int i = 0; i < chain->n; i++) {
        double motion[3];
        motion_of(chain, pose, i, tip, motion);
        for (int row = 0; row < 3; row++)
            jacobian[row * chain->n + i] = motion[row];
    }
}

/* d E u / d w of a joint that turns, in the frame before it: of
 *   E u = u + s w x u + (1 - c) (w (w . u) - u |w|^2)
 * at a unit w. */
static void turn_by_axis(const double *w, double angle, const double *u, double *D)
{
    double s;
    double c;

    elementary_sin_cos(angle, &s, &c);
    double v = 1.0 - c;
    double wu = vec3_dot(w, u);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            D[3 * i + k] = v * (w[i] * u[k] - 2.0 * u[i] * w[k] + (i == k ? wu : 0.0));
    D[1] += s * u[2];
    D[2] -= s * u[1];
    D[3] -= s * u[2];
    D[5] += s * u[0];
    D[6] += s * u[1];
    D[7] -= s * u[0];
}

/* d tip / d axis_i, in the base's frame: only what turns the axis counts, not what lengthens it. */
static void slope_by_axis(const struct chain *chain, const struct chain_pose *pose, int i,
                          const double *tip, double *slope)
{
    const double *w = chain->axis[i];
    double D[9] = {pose->moved[i], 0, 0, 0, pose->moved[i], 0, 0, 0, pose->moved[i]};
    double across[9];
    double lever[3];
    double u[3];

    if (!chain->slides[i]) {
        memcpy(lever, tip, sizeof lever);
        vec3_add(-1.0, pose->place[i], lever);
        mat3_apply_transposed(pose->turn[i + 1], lever, u);
        turn_by_axis(w, pose->moved[i], u, D);
    }
    for (int row = 0; row < 3; row++) {
        double along = vec3_dot(D + (ptrdiff_t)3 * row, w);
        for (int k = 0; k < 3; k++)
            across[3 * row + k] = D[3 * row + k] - along * w[k];
    }
    mat3_multiply(pose->turn[i], across, slope);
}

void chain_slope(const struct chain *chain, const struct chain_pose *pose, const double *tip,
                 double *slope)
{
    size_t n = 6 * (size_t)chain->n;

    for (int i = 0; i < chain->n; i++) {
        double by_axis[9];
        slope_by_axis(chain, pose, i, tip, by_axis);
        for (int row = 0; row < 3; row++)
            for (int k = 0; k < 3; k++) {
                slope[(size_t)row * n + (size_t)(3 * i + k)] = by_axis[3 * row + k];
                slope[(size_t)row * n + (size_t)(3 * (chain->n + i) + k)] =
                    pose->turn[i][3 * row + k];
            }
    }
}
