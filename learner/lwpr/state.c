/* The receptive fields' state as bytes, and back. What can be derived from it is not stored. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/lwpr/lwpr.h"

size_t lwpr_state_size(const void *self, int n_experts)
{
    size_t total = 0;
    size_t bytes = 0;

    for (int k = 0; lwpr_state_part(self, 0, k, &bytes); k++)
        total += bytes;
    return (size_t)n_experts * total;
}

void lwpr_save(const void *self, unsigned char *buffer)
{
    const struct lwpr *m = self;
    const void *part;
    size_t bytes = 0;

    for (int j = 0; j < m->M; j++)
        for (int k = 0; (part = lwpr_state_part(m, j, k, &bytes)); k++) {
            memcpy(buffer, part, bytes);
            buffer += bytes;
        }
}

static bool all_finite(const double *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(numbers[i]))
            return false;
    return true;
}

static bool whole_between(double number, int least, int most)
{
    return number >= least && number <= most && number == floor(number);
}

static bool head_fits(const struct lwpr *m, const struct lwpr_head *head)
{
    return whole_between(head->output, 0, m->D - 1) &&
           whole_between(head->n_projections, 1, m->R) && head->dof >= 0.0;
}

static bool metric_fits(const struct lwpr *m, const struct lwpr_field *f)
{
    for (int i = 0; i < m->n_root; i++)
        if (!(fabs(f->root[i]) <= LWPR_LARGEST_ROOT) || !(f->rate[i] >= 0.0))
            return false;
    for (int row = 0, i = 0; row < m->d; i = lwpr_next_diagonal(m, i, row++))
        if (!(f->root[i] >= LWPR_SMALLEST_ROOT))
            return false;
    return true;
}

static bool stages_fit(const struct lwpr *m, const struct lwpr_field *f)
{
    for (int r = 0; r < m->R; r++) {
        const struct lwpr_stage *stage = &f->stage[r];
        if (!(stage->lambda >= 0.99 && stage->lambda <= 1.0 && stage->n >= 0.0 && stage->W >= 0.0 &&
              stage->V >= 0.0 && stage->SS >= m->p.init_s2 && stage->E >= 0.0 && stage->G >= 0.0))
            return false;
    }
    return f->stage[0].W > 0.0;
}

/* The checksum guards against damage; this, against a state that never was one. Field `f` holds
 * what was saved. */
static bool field_fits(const struct lwpr *m, int j)
{
    const struct lwpr_field f = lwpr_field_at(m, j);
    const double *part;
    size_t bytes = 0;

    for (int k = 0; (part = lwpr_state_part(m, j, k, &bytes)); k++)
        if (!all_finite(part, bytes / sizeof(double)))
            return false;
    return head_fits(m, f.head) && metric_fits(m, &f) && stages_fit(m, &f);
}

static void get_field(struct lwpr *m, int j, const unsigned char *buffer)
{
    size_t bytes = 0;
    void *part;

    for (int k = 0; (part = lwpr_state_part(m, j, k, &bytes)); k++) {
        memcpy(part, buffer, bytes);
        buffer += bytes;
    }
}

int lwpr_load(void *self, int n_experts, const unsigned char *buffer, char *err, size_t err_size)
{
    struct lwpr *m = self;
    size_t size = lwpr_state_size(m, 1);

    /* Looked at one by one in the place past the last field, so that a refusal changes nothing. */
    for (int j = 0; j < n_experts; j++) {
        get_field(m, m->config.capacity, buffer + (size_t)j * size);
        if (!field_fits(m, m->config.capacity)) {
            snprintf(err, err_size, "it holds numbers that no state can have");
            return -1;
        }
    }
    m->M = n_experts;
    for (int j = 0; j < n_experts; j++) {
        get_field(m, j, buffer + (size_t)j * size);
        const struct lwpr_field f = lwpr_field_at(m, j);
        lwpr_pls_refresh(m, &f);
    }
    return 0;
}
