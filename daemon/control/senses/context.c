#include "daemon/control/senses/context.h"

#include <math.h>
#include <string.h>

/* A value that moves farther than this in one tick has jumped; in units of the estimate's scale,
 * in which the fastest arm moves some 0.1. */
static const double jump = 0.25;

void context_init(struct context *context)
{
    memset(context, 0, sizeof *context);
    context->principal = -1;
    context->waiting = -1;
}

static bool jumped(const struct context *context, const struct estimate *estimate,
                   const double *value)
{
    double square = 0;

    for (int row = 0; row < estimate->n_outputs; row++) {
        double step = (value[row] - context->value[row]) / estimate->scale[row];
        square += step * step;
    }
    return sqrt(square) > jump;
}

/* An expert outside the current context is followed: believed only after some time, for a jump may
 * have been an error. One whose context is not known begins a new one. */
static void wait_for(struct context *context, int principal)
{
    if (context->waiting != principal) {
        context->waiting = principal;
        context->ticks = 0;
    }
    if (++context->ticks < CONTEXT_SETTLE)
        return;
    if (context->label[principal] == 0)
        context->label[principal] = (int16_t)++context->count;
    context->current = context->label[principal];
    context->waiting = -1;
}

void context_follow(struct context *context, const struct estimate *estimate)
{
    const double *value = estimate_value(estimate);

    if (!value) {
        context->principal = -1;
        return;
    }
    int principal = estimate->prediction.solution[estimate->solution].principal;
    if (principal >= CONTEXT_EXPERTS)
        return;
    bool passed_on = context->principal >= 0 && context->principal != principal &&
                     !jumped(context, estimate, value);
    if (passed_on && context->label[principal] == 0)
        context->label[principal] = context->label[context->principal];
    if (context->current > 0 && context->label[principal] == context->current)
        context->waiting = -1;
    else
        wait_for(context, principal);
    context->principal = principal;
    memcpy(context->value, value, sizeof(double) * (size_t)estimate->n_outputs);
}
