/* Which experts are near: what a scan over all of them reads, and the scan. Experts lie in blocks
 * of eight, one a lane, so that eight distances are computed at once (kernels.h). Densities are
 * logarithms: far from all experts they underflow, and their ratios still matter. */
#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/imle/imle.h"
#include "learner/imle/triangle.h"

static int blocks_of(int experts)
{
    return (experts + KERNEL_LANES - 1) / KERNEL_LANES;
}

size_t imle_lanes_block(int d)
{
    return ((size_t)d + whitener_row(d)) * KERNEL_LANES;
}

size_t imle_lanes_experts(const struct learner_config *config)
{
    return (size_t)blocks_of(config->capacity) * KERNEL_LANES;
}

/* Where expert j's first number is; its numbers are KERNEL_LANES apart. */
static double *lane_of(const struct imle *m, int j)
{
    return m->derived.lanes + (size_t)(j / KERNEL_LANES) * imle_lanes_block(m->d) +
           (size_t)(j % KERNEL_LANES);
}

void imle_scan_distances(struct imle *m, const double *z)
{
    m->kernels->distances(m->d, blocks_of(m->state.M), m->derived.lanes, z, m->query.q);
}

/* log t of n experts from `first` on, both multiples of eight. */
static void densities_of_blocks(struct imle *m, int first, int n)
{
    m->kernels->log_student(n, m->query.q + first, m->derived.gate.per_a + first,
                            m->derived.gate.exponent + first, m->derived.gate.log_norm + first,
                            m->query.log_t + first);
}

void imle_density_near(struct imle *m, int j)
{
    densities_of_blocks(m, j / KERNEL_LANES * KERNEL_LANES, KERNEL_LANES);
}

void imle_densities(struct imle *m)
{
    densities_of_blocks(m, 0, blocks_of(m->state.M) * KERNEL_LANES);
}

void imle_lanes_write(struct imle *m, int j, double scale, const double *G)
{
    const double *nu = m->state.nu + (size_t)j * (size_t)m->d;
    double *lane = lane_of(m, j);

    for (int i = 0; i < m->d; i++, lane += KERNEL_LANES)
        *lane = nu[i];
    for (size_t i = 0; i < whitener_row(m->d); i++, lane += KERNEL_LANES)
        *lane = scale * G[i];
}

double imle_gate_pull(const struct imle *m, int j, const double *z, double *pull)
{
    const double *nu = lane_of(m, j);
    const double *root = nu + (size_t)m->d * KERNEL_LANES;
    double q = 0.0;

    memset(pull, 0, (size_t)m->d * sizeof *pull);
    for (int r = 0; r < m->d; r++) {
        double y = 0.0;
        for (int c = 0; c <= r; c++)
            y += root[c * KERNEL_LANES] * (z[c] - nu[c * KERNEL_LANES]);
        for (int c = 0; c <= r; c++)
            pull[c] += root[c * KERNEL_LANES] * y;
        q += y * y;
        root += (size_t)(r + 1) * KERNEL_LANES;
    }
    return q;
}

void imle_gate_precision(const struct imle *m, int j, double *packed)
{
    const double *root = lane_of(m, j) + (size_t)m->d * KERNEL_LANES;

    memset(packed, 0, triangle_size(m->d) * sizeof *packed);
    for (int r = 0; r < m->d; r++) {
        for (int c = 0; c <= r; c++)
            for (int k = c; k <= r; k++)
                packed[triangle_column(m->d, c) + (size_t)(k - c)] +=
                    root[c * KERNEL_LANES] * root[k * KERNEL_LANES];
        root += (size_t)(r + 1) * KERNEL_LANES;
    }
}

double imle_log_outlier_input(const struct imle *m)
{
    double value = m->log_c_input;

    for (int i = 0; i < m->d; i++)
        value -= 0.5 * elementary_log(m->state.sigma_bar[i]);
    return value;
}

double imle_log_outlier_joint(const struct imle *m)
{
    double value = imle_log_outlier_input(m) - m->log_c_input + m->log_c_joint;

    for (int i = 0; i < m->D; i++)
        value -= 0.5 * elementary_log(m->state.psi_bar[i]);
    return value;
}
