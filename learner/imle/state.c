/* The mixture's state as bytes, and back. What can be derived from the state is not stored. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/imle/imle.h"

/* Counts of the mixture itself, which follow both shared priors and where outputs were. */
struct counts {
    double outliers_in_row;
    double candidates;
    double samples;
};

static size_t shared_numbers(const struct imle *m)
{
    return (size_t)(m->d + 3 * m->D) + sizeof(struct counts) / sizeof(double);
}

int imle_saved_experts(const void *self)
{
    const struct imle *m = self;

    return m->state.M + m->state.candidates;
}

/* Candidates are saved behind the experts. */
static int place_of(const struct imle *m, int saved)
{
    return saved < m->state.M ? saved : imle_candidate_place(m, saved - m->state.M);
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
    m->state.candidates = 0;
    m->state.samples = 0.0;
    memset(m->state.seen, 0, 2 * (size_t)m->D * sizeof(double));
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
    struct counts counts = {m->state.outliers_in_row, m->state.candidates, m->state.samples};
    struct imle_part part;

    buffer = put_bytes(buffer, m->state.sigma_bar, (size_t)m->d * sizeof(double));
    buffer = put_bytes(buffer, m->state.psi_bar, (size_t)m->D * sizeof(double));
    buffer = put_bytes(buffer, m->state.seen, 2 * (size_t)m->D * sizeof(double));
    buffer = put_bytes(buffer, &counts, sizeof counts);
    for (int i = 0; i < imle_saved_experts(m); i++) {
        int j = place_of(m, i);
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

static void copy_state(struct imle *m, int n_experts, const unsigned char *buffer)
{
    struct counts counts;
    struct imle_part part;

    buffer = get_bytes(m->state.sigma_bar, buffer, (size_t)m->d * sizeof(double));
    buffer = get_bytes(m->state.psi_bar, buffer, (size_t)m->D * sizeof(double));
    buffer = get_bytes(m->state.seen, buffer, 2 * (size_t)m->D * sizeof(double));
    buffer = get_bytes(&counts, buffer, sizeof counts);
    m->state.outliers_in_row = (int)counts.outliers_in_row;
    m->state.candidates = (int)counts.candidates;
    m->state.M = n_experts - m->state.candidates;
    m->state.samples = counts.samples;
    for (int i = 0; i < n_experts; i++) {
        int j = place_of(m, i);
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
           s->prior_psi > 0.0 && s->turn >= 0.0 && s->turn < m->p && s->last >= -1.0 &&
           s->last < 1e15 && s->row >= 0.0 && s->row < 1e15 && fabs(s->score) < 1e15 &&
           s->remembers >= 0.0 && s->remembers <= IMLE_REMEMBERED;
}

/* The checksum guards against damage; this, against a state that never was one. */
static bool state_fits(const struct imle *m, int n_experts, const unsigned char *buffer)
{
    struct imle_part shared = {NULL, (size_t)(m->d + m->D), 0, true};
    struct imle_part seen = {NULL, 2 * (size_t)m->D, 0, false};
    struct imle_strengths strengths;
    struct imle_part part;
    struct counts counts;

    if (!part_fits(&shared, buffer))
        return false;
    buffer += shared.size * sizeof(double);
    if (!part_fits(&seen, buffer))
        return false;
    buffer = get_bytes(&counts, buffer + seen.size * sizeof(double), sizeof counts);
    if (!(counts.outliers_in_row >= 0.0 && counts.outliers_in_row <= m->config.n_outliers) ||
        !(counts.samples >= 0.0 && counts.samples < 1e15) ||
        !(counts.candidates >= 0.0 &&
          counts.candidates <= (m->by_evidence ? IMLE_CANDIDATES : 0)) ||
        counts.candidates > n_experts)
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
    copy_state(m, n_experts, buffer);
    for (int i = 0; i < n_experts; i++)
        imle_expert_refresh(m, place_of(m, i));
    return 0;
}
