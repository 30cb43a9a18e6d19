#include "learner/body/tool/design.h"

#include <math.h>
#include <string.h>

#include "learner/body/chain/vec3.h"

/* Prior standard deviations, of the body's length: a tool as long as the arm reaches; a droop of
 * some centimetres, a remainder of one, for an arm of half a metre. */
static const double share_tip = 1.5;
static const double share_droop = 0.4;
static const double share_constant = 0.03;
static const double share_linear = 0.06;
static const double share_quadratic = 0.04;
static const double share_across = 0.5;
static const double share_odd = 0.15;
static const double share_stub = 0.3;
static const double least_range = 0.3; /* rad */

static int monomials(int n, int degree)
{
    return 1 + n + (degree > 1 ? n * (n + 1) / 2 : 0);
}

void design_init(struct design *design, const struct body *body)
{
    int n = body->chain.n;
    int rigid = DESIGN_TIP + DESIGN_DROOP;

    design->n_joints = n;
    design->degree = rigid + 3 * monomials(n, 2) <= DESIGN_MAX ? 2 : 1;
    design->size[0] = DESIGN_TIP;
    design->size[1] = rigid;
    design->size[2] = rigid + 3 * monomials(n, design->degree);
    for (int i = 0; i < n; i++)
        design->range[i] = fmax(body->range[i], least_range);
    design->sd_tip = share_tip * body->length;
    design->sd_droop = share_droop * body->length;
    design->sd_across = share_across * body->length;
    design->sd_odd = share_odd * body->length;
    design->stub = share_stub * body->length;
    design->sd_constant = share_constant * body->length;
    design->sd_linear = share_linear * body->length;
    design->sd_quadratic = share_quadratic * body->length;
}

void design_droop_prior(const struct design *design, const double *tip, double *covariance)
{
    const double length = vec3_dot(tip, tip) + design->stub * design->stub;
    const double across = design->sd_across / design->sd_droop;
    const double odd = design->sd_odd / design->sd_droop;
    double bends[9];

    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            bends[3 * i + k] = (i == k ? 1.0 : 0.0) - tip[i] * tip[k] / length;
    for (int i = 0; i < DESIGN_DROOP; i++)
        for (int k = 0; k < DESIGN_DROOP; k++)
            covariance[DESIGN_DROOP * i + k] =
                across * across * bends[i] * bends[k] + (i == k ? odd * odd : 0.0);
}

/* The k-th monomial of u goes to rows r, column 3 k + r behind the rigid part. */
static void put_monomial(const struct design *design, double *rows, int k, double value)
{
    int P = design->size[2];

    for (int r = 0; r < 3; r++)
        rows[r * P + DESIGN_TIP + DESIGN_DROOP + 3 * k + r] = value;
}

static void joints_over_range(const struct design *design, const struct chain_pose *pose, double *u)
{
    for (int i = 0; i < design->n_joints; i++)
        u[i] = pose->moved[i] / design->range[i];
}

static void remainder_rows(const struct design *design, const struct chain_pose *pose, double *rows)
{
    double u[CHAIN_MAX_JOINTS];
    int k = 0;

    joints_over_range(design, pose, u);
    put_monomial(design, rows, k++, design->sd_constant);
    for (int i = 0; i < design->n_joints; i++)
        put_monomial(design, rows, k++, design->sd_linear * u[i]);
    for (int i = 0; design->degree > 1 && i < design->n_joints; i++)
        for (int j = i; j < design->n_joints; j++)
            put_monomial(design, rows, k++, design->sd_quadratic * u[i] * u[j]);
}

void design_rows(const struct design *design, const struct body *body,
                 const struct chain_pose *pose, double *rows)
{
    const double *R = pose->turn[body->chain.n];
    int P = design->size[2];
    double felt[3];

    memset(rows, 0, 3 * (size_t)P * sizeof *rows);
    mat3_apply_transposed(R, body->gravity, felt);
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++) {
            rows[r * P + k] = design->sd_tip * R[3 * r + k];
            for (int b = 0; b < 3; b++)
                rows[r * P + DESIGN_TIP + 3 * k + b] = design->sd_droop * R[3 * r + k] * felt[b];
        }
    remainder_rows(design, pose, rows);
}

/* The tip's motion with the joints that turn: a_i x (R o), and of R A R' g:
 * a_i x (R A R' g) - R A R' (a_i x g). */
static void rigid_slope(const struct design *design, const struct body *body,
                        const struct chain_pose *pose, int size, const double *theta, double *slope)
{
    const double *R = pose->turn[body->chain.n];
    double A[9] = {0};
    double tip[3];
    double felt[3];
    double given[3];
    double turned[3];

    for (int k = 0; k < 3; k++)
        tip[k] = design->sd_tip * theta[k];
    for (int k = 0; k < 9 && size > DESIGN_TIP; k++)
        A[k] = design->sd_droop * theta[DESIGN_TIP + k];
    mat3_apply_transposed(R, body->gravity, felt);
    mat3_apply(A, felt, given);
    vec3_add(1.0, given, tip);
    mat3_apply(R, tip, turned);
    for (int i = 0; i < design->n_joints; i++) {
        double moved[3] = {0, 0, 0};
        if (!body->chain.slides[i]) {
            double across[3];
            double back[3];
            vec3_cross(pose->axis[i], turned, moved);
            vec3_cross(pose->axis[i], body->gravity, across);
            mat3_apply_transposed(R, across, felt);
            mat3_apply(A, felt, given);
            mat3_apply(R, given, back);
            vec3_add(-1.0, back, moved);
        }
        for (int r = 0; r < 3; r++)
            slope[r * design->n_joints + i] = moved[r];
    }
}

static void remainder_slope(const struct design *design, const struct chain_pose *pose,
                            const double *theta, double *slope)
{
    const double *b = theta + DESIGN_TIP + DESIGN_DROOP;
    double u[CHAIN_MAX_JOINTS];
    int n = design->n_joints;
    int k = 1 + n;

    joints_over_range(design, pose, u);
    for (int r = 0; r < 3; r++)
        for (int i = 0; i < n; i++)
            slope[r * n + i] += design->sd_linear * b[3 * (1 + i) + r] / design->range[i];
    for (int i = 0; design->degree > 1 && i < n; i++)
        for (int j = i; j < n; j++, k++)
            for (int r = 0; r < 3; r++) {
                double c = design->sd_quadratic * b[3 * k + r];
                slope[r * n + i] += c * u[j] / design->range[i];
                slope[r * n + j] += c * u[i] / design->range[j];
            }
}

void design_slope(const struct design *design, const struct body *body,
                  const struct chain_pose *pose, int size, const double *theta, double *slope)
{
    rigid_slope(design, body, pose, size, theta, slope);
    if (size > DESIGN_TIP + DESIGN_DROOP)
        remainder_slope(design, pose, theta, slope);
}
