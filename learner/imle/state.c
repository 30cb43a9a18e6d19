/* The mixture's state as bytes, and back. What can be derived from the state is not stored. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/imle/imle.h"

/* Numbers of the mixture itself: both shared priors, and the outliers in a row. */
static size_t shared_numbers(const struct imle *m)
{
    return (size_t)(m->d + m->D) + 1;
}

static size_t expert_numbers(const struct imle *m)
{
    size_t total = sizeof(struct imle_strengths) / sizeof(double);
    struct imle_part part;

    for (int k = 0; imle_state_part(m, 0, k, &part); k++)
        total += part.size;
    return total;
}

void imle_forget(struct imle *m)
{
    m->state.M = 0;
    m->state.outliers_in_row = 0;
    memcpy(m->state.sigma_bar, m->config.sigma0, (size_t)m->d * sizeof(double));
    memcpy(m->state.psi_bar, m->config.psi0, (size_t)m->D * sizeof(double));
}

size_t imle_state_size(const void *self, int n_experts)
{
    const struct imle *m = self;

    return (shared_numbers(m) + (size_t)n_experts * expert_numbers(m)) * sizeof(double);
}

static unsigned char *put_bytes(unsigned char *to, const void *from, size_t bytes)
{
    memcpy(to, from, bytes);
    return to + bytes;
}

void imle_save(const void *self, unsigned char *buffer)
{
    const struct imle *m = self;
    double outliers = m->state.outliers_in_row;
    struct imle_part part;

    buffer = put_bytes(buffer, m->state.sigma_bar, (size_t)m->d * sizeof(double));
    buffer = put_bytes(buffer, m->state.psi_bar, (size_t)m->D * sizeof(double));
    buffer = put_bytes(buffer, &outliers, sizeof outliers);
    for (int j = 0; j < m->state.M; j++) {
        buffer = put_bytes(buffer, &m->state.strengths[j], sizeof m->state.strengths[j]);
        for (int k = 0; imle_state_part(m, j, k, &part); k++)
            buffer = put_bytes(buffer, part.begin, part.size * sizeof(double));
    }
}

static const unsigned char *get_bytes(void *to, const unsigned char *from, size_t bytes)
{
    memcpy(to, from, bytes);
    return from + bytes;
}

static void copy_state(struct imle *m, const unsigned char *buffer)
{
    double outliers = 0.0;
    struct imle_part part;

    buffer = get_bytes(m->state.sigma_bar, buffer, (size_t)m->d * sizeof(double));
    buffer = get_bytes(m->state.psi_bar, buffer, (size_t)m->D * sizeof(double));
    buffer = get_bytes(&outliers, buffer, sizeof outliers);
    m->state.outliers_in_row = (int)outliers;
    for (int j = 0; j < m->state.M; j++) {
        buffer = get_bytes(&m->state.strengths[j], buffer, sizeof m->state.strengths[j]);
        for (int k = 0; imle_state_part(m, j, k, &part); k++)
            buffer = get_bytes(part.begin, buffer, part.size * sizeof(double));
    }
}

/* Whether the bytes at `buffer` can be this part of an expert. */
static bool part_fits(const struct imle_part *part, const unsigned char *buffer)
{
    size_t next_diagonal = 0;
    size_t row = 0;
    double number = 0.0;

    for (size_t i = 0; i < part->size; i++) {
        buffer = get_bytes(&number, buffer, sizeof number);
        bool on_diagonal = part->order > 0 && i == next_diagonal;
        if (!isfinite(number) || ((part->positive || on_diagonal) && !(number > 0.0)))
            return false;
        if (on_diagonal)
            next_diagonal += ++row + 1;
    }
    return true;
}

static bool strengths_fit(const struct imle *m, const struct imle_strengths *s)
{
    return s->H > 0.0 && s->H < 1e15 && s->S > 0.0 && s->S < 1e15 && s->prior_sigma >= m->d &&
           s->prior_sigma < 1e15 && s->prior_nu >= 0.0 && s->prior_nu < 1e15 &&
           s->prior_psi > 0.0 && s->turn >= 0.0 && s->turn < m->p;
}

/* The checksum guards against damage; this, against a state that never was one. */
static bool state_fits(const struct imle *m, int n_experts, const unsigned char *buffer)
{
    struct imle_part shared = {NULL, (size_t)(m->d + m->D), 0, true};
    struct imle_strengths strengths;
    struct imle_part part;
    double outliers = 0.0;

    if (!part_fits(&shared, buffer))
        return false;
    buffer = get_bytes(&outliers, buffer + shared.size * sizeof(double), sizeof outliers);
    if (!(outliers >= 0.0 && outliers <= m->config.n_outliers))
        return false;
    for (int j = 0; j < n_experts; j++) {
        buffer = get_bytes(&strengths, buffer, sizeof strengths);
        if (!strengths_fit(m, &strengths))
            return false;
        for (int k = 0; imle_state_part(m, 0, k, &part); k++) {
            if (!part_fits(&part, buffer))
                return false;
            buffer += part.size * sizeof(double);
        }
    }
    return true;
}

int imle_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size)
{
    struct imle *m = self;

    if (!state_fits(m, n_experts, buffer)) {
        snprintf(err, err_size, "it holds numbers that no state can have");
        return -1;
    }
    m->state.M = n_experts;
    copy_state(m, buffer);
    for (int j = 0; j < m->state.M; j++)
        imle_expert_refresh(m, j);
    return 0;
}
