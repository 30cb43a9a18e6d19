/* What an expert answers to the query whose features are m->query.phi, and how sure it is of it.
 * Experts with few features answer in blocks of eight, from a copy of what that needs laid out for
 * vectors; the others one by one. */
#include <string.h>

#include "learner/imle/imle.h"

static int block_of(int j)
{
    return j / KERNEL_LANES;
}

void imle_new_query(struct imle *m, const double *x)
{
    m->query.whitened = -1;
    memset(m->query.target, 0, sizeof m->query.target);
    if (x)
        memcpy(m->query.target, x, (size_t)m->D * sizeof *x);
    size_t blocks = (size_t)block_of(m->config.capacity) + 1;
    memset(m->query.answered, 0, blocks * sizeof *m->query.answered);
    memset(m->query.levered, 0, blocks * sizeof *m->query.levered);
}

size_t imle_regression_block(int p, int D)
{
    return ((size_t)p + whitener_row(p) + (size_t)D * (2 + (size_t)p)) * KERNEL_LANES;
}

/* Every eighth number from `lane` on becomes the next from numbers[n]; returns the one after. */
static double *write_lane(double *lane, const double *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++, lane += KERNEL_LANES)
        *lane = numbers[i];
    return lane;
}

void imle_regression_write(struct imle *m, int j)
{
    size_t p = (size_t)m->p;
    size_t D = (size_t)m->D;
    size_t e = (size_t)j;

    if (!m->small)
        return;
    double *lane = m->derived.regression + (size_t)block_of(j) * imle_regression_block(m->p, m->D) +
                   (size_t)(j % KERNEL_LANES);
    lane = write_lane(lane, m->state.phibar + e * p, p);
    lane = write_lane(lane, m->state.whitener + e * whitener_row(m->p), whitener_row(m->p));
    for (size_t i = 0; i < D; i++) {
        double per_psi = 1.0 / m->state.psi[e * D + i];
        lane = write_lane(lane, &per_psi, 1);
        lane = write_lane(lane, m->state.xbar + e * D + i, 1);
        lane = write_lane(lane, m->state.W + (e * D + i) * p, p);
    }
}

static const double *block_with(const struct imle *m, int j)
{
    return m->derived.regression + (size_t)block_of(j) * imle_regression_block(m->p, m->D);
}

/* The answers of expert j and its seven neighbours, unless they are known already. */
static void answer_block(struct imle *m, int j)
{
    int block = block_of(j);

    if (m->query.answered[block])
        return;
    m->query.answered[block] = true;
    m->kernels->regress(m->p, m->D, block_with(m, j), m->query.phi, m->query.target,
                        m->query.outputs + (size_t)(block * m->D) * KERNEL_LANES,
                        m->query.misfits + (size_t)block * KERNEL_LANES);
}

/* Their leverages; apart, for far fewer experts are asked how sure they are than what they say. */
static void lever_block(struct imle *m, int j)
{
    int block = block_of(j);

    if (m->query.levered[block])
        return;
    m->query.levered[block] = true;
    m->kernels->leverages(m->p, block_with(m, j), m->query.phi,
                          m->query.leverages + (size_t)block * KERNEL_LANES);
}

void imle_forget_answers(struct imle *m, int j)
{
    m->query.answered[block_of(j)] = m->query.levered[block_of(j)] = false;
    if (m->query.whitened == j)
        m->query.whitened = -1;
}

static void center_features(struct imle *m, int j)
{
    const double *phibar = m->state.phibar + (size_t)j * (size_t)m->p;

    for (int k = 0; k < m->p; k++)
        m->query.offset[k] = m->query.phi[k] - phibar[k];
}

static void output_alone(struct imle *m, int j, double *xhat)
{
    const double *xbar = m->state.xbar + (size_t)j * (size_t)m->D;

    center_features(m, j);
    m->kernels->apply(m->p, m->D, m->state.W + (size_t)j * (size_t)m->p * (size_t)m->D,
                      m->query.offset, xhat);
    for (int i = 0; i < m->D; i++)
        xhat[i] += xbar[i];
}

void imle_expert_output(struct imle *m, int j, double *xhat)
{
    if (!m->small) {
        output_alone(m, j, xhat);
        return;
    }
    answer_block(m, j);
    for (int i = 0; i < m->D; i++)
        xhat[i] = m->query.outputs[(block_of(j) * m->D + i) * KERNEL_LANES + j % KERNEL_LANES];
}

static double misfit_alone(struct imle *m, int j)
{
    const double *psi = m->state.psi + (size_t)j * (size_t)m->D;
    double xhat[LEARNER_MAX_OUTPUTS];
    double sum = 0.0;

    output_alone(m, j, xhat);
    for (int i = 0; i < m->D; i++)
        sum += (m->query.target[i] - xhat[i]) * (m->query.target[i] - xhat[i]) / psi[i];
    return sum;
}

const double *imle_expert_misfits(struct imle *m, int j)
{
    if (m->small)
        answer_block(m, j);
    else
        m->query.misfits[j] = misfit_alone(m, j);
    return m->query.misfits + j;
}

double imle_expert_misfit(struct imle *m, int j)
{
    return *imle_expert_misfits(m, j);
}

/* by_input[d] = dphi' by_feature[p]: from derivatives by features to those by inputs. */
static void to_inputs(const struct imle *m, const double *by_feature, double *by_input)
{
    if (m->config.features == LEARNER_LINEAR) /* dphi is diagonal */
        for (int i = 0; i < m->d; i++)
            by_input[i] = m->query.dphi[i * m->p + i] * by_feature[i];
    else
        m->kernels->apply(m->p, m->d, m->query.dphi, by_feature, by_input);
}

void imle_expert_slope(struct imle *m, int j)
{
    const double *W = m->state.W + (size_t)j * (size_t)m->p * (size_t)m->D;

    for (int i = 0; i < m->D; i++)
        to_inputs(m, W + (size_t)i * (size_t)m->p, m->query.slope + (size_t)i * (size_t)m->d);
}

void imle_expert_whiten(struct imle *m, int j)
{
    center_features(m, j);
    if (m->query.whitened == j)
        return;
    m->kernels->whiten(m->p, m->state.whitener + (size_t)j * whitener_row(m->p), m->query.offset,
                       m->query.white, m->query.gain);
    m->query.whitened = j;
    m->query.leverage = m->kernels->dot(m->p, m->query.white, m->query.white);
}

/* (phi - phibar)' C^-1 (phi - phibar) of expert j at the features m->query.phi. */
static double leverage_of(struct imle *m, int j)
{
    if (m->small) {
        lever_block(m, j);
        return m->query.leverages[j];
    }
    imle_expert_whiten(m, j);
    return m->query.leverage;
}

double imle_expert_gamma(struct imle *m, int j)
{
    return m->config.noise_share * (leverage_of(m, j) + 1.0 / m->state.strengths[j].S);
}

void imle_gamma_slope(struct imle *m, struct imle_answer *answer)
{
    if (answer->sloped)
        return;
    imle_expert_whiten(m, answer->expert);
    to_inputs(m, m->query.gain, answer->dgamma);
    for (int i = 0; i < m->d; i++)
        answer->dgamma[i] *= 2.0 * m->config.noise_share;
    answer->sloped = true;
}
