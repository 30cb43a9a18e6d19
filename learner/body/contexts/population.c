#include "learner/body/contexts/population.h"

#include <math.h>
#include <string.h>

#include "learner/body/chain/vec3.h"

/* More than a mistake: so many samples, which it has foretold so much better than nothing would. By
 * chance a tip that droops explains any two or three samples, though not well. */
static const double confirming_samples = 2.5;
static const double confirming_gain = 25.0;
static const double confirming_gain_each = 5.0;
static const double probation = 30.0; /* samples within which these must come */
/* A tool that was never in hand longer than some tenths of a second, and not since: something stood
 * there for the ball. */
static const double fleeting = 15.0;
static const double long_gone = 1000.0;
static const double not_since = 1e-4;
static const double twins = 30.0; /* samples in a row that make two contexts one */
/* One that fits this well is fitted: 1 % lies beyond. */
static const double fits = 11.3;
/* Sizes of a design whose evidence is that near to the chosen one's are believed, too. */
static const double plausible = 6.0;

/* Misfits whose mean is 1 add up beyond this, to that much. */
static const double slack = 2.0;
static const double most_strain = 8.0;

const double contexts_recent_share = 0.05;

void contexts_hold(struct contexts *contexts, int j)
{
    struct tied *tied = &contexts->context[j].tied;
    double apart[3];
    double length[3];

    memcpy(apart, contexts->place, sizeof apart);
    vec3_add(-1.0, contexts->pose.p, apart);
    mat3_apply_transposed(contexts->pose.turn[contexts->body->chain.n], apart, length);
    if (j > 0)
        vec3_add(-contexts->design.sd_tip, contexts->context[0].tied.theta[0], length);
    tied_reset(tied, &contexts->design, j > 0 ? length : NULL);
}

void contexts_begin(struct contexts *contexts, int j)
{
    struct context *context = &contexts->context[j];

    context->number = fmod(contexts->births, CONTEXTS_NUMBERS);
    context->support = context->age = context->twin = context->strain = 0.0;
    context->recent = contexts_recent_share;
    context->gain = 0.0;
    context->confirmed = false;
    contexts->gain[j] = 0.0;
    context->scale = 1.0;
    context->slip = 0.0;
    context->anchor.known = context->anchor.slips = false;
    contexts_hold(contexts, j);
    kept_clear(&context->kept);
}

bool contexts_confirmed(const struct context *context)
{
    return context->confirmed;
}

void contexts_try(struct context *context)
{
    double enough = fmax(confirming_gain, confirming_gain_each * context->support);

    context->confirmed =
        context->confirmed || (context->support >= confirming_samples && context->gain >= enough);
}

double contexts_distance_of(const struct context *context, const struct tied_fit *fit)
{
    const struct tied *tied = &context->tied;
    double least = fit->distance[tied->chosen];

    for (int k = 0; k < DESIGN_SIZES; k++)
        if (tied->evidence[k] > tied->evidence[tied->chosen] - plausible)
            least = fmin(least, fit->distance[k]);
    return least / context->scale;
}

bool contexts_strained(struct contexts *contexts, int winner)
{
    struct context *context = &contexts->context[winner];
    double misfit = contexts_distance_of(context, &contexts->fit[winner]) / BODY_OUTPUTS;

    context->strain = fmax(context->strain + fmin(misfit, fits) - slack, 0.0);
    if (!contexts_confirmed(context) || context->strain < most_strain)
        return false;
    context->strain = 0.0;
    return true;
}

void contexts_remove_context(struct contexts *contexts, int j)
{
    struct context gone = contexts->context[j];
    size_t behind = (size_t)(contexts->n - j - 1);

    memmove(&contexts->context[j], &contexts->context[j + 1], behind * sizeof gone);
    memmove(&contexts->fit[j], &contexts->fit[j + 1], behind * sizeof contexts->fit[0]);
    memmove(&contexts->h[j], &contexts->h[j + 1], behind * sizeof contexts->h[0]);
    memmove(&contexts->gain[j], &contexts->gain[j + 1], behind * sizeof contexts->gain[0]);
    contexts->n--;
    contexts->context[contexts->n] = gone; /* its room is used again */
}

int contexts_count_confirmed(const struct contexts *contexts)
{
    int count = 0;

    for (int j = 0; j < contexts->n; j++)
        count += contexts_confirmed(&contexts->context[j]);
    return count;
}

/* Who goes when there is no room, beside `stays`: the one on probation that explains least, or the
 * confirmed one that least of the newest samples were of. */
static int dispensable(const struct contexts *contexts, bool on_probation, int stays)
{
    int chosen = -1;

    for (int j = 0; j < contexts->n; j++) {
        const struct context *context = &contexts->context[j];
        const struct context *other = chosen < 0 ? NULL : &contexts->context[chosen];
        if (j == stays || contexts_confirmed(context) == on_probation)
            continue;
        if (!other ||
            (on_probation ? context->gain < other->gain : context->recent < other->recent))
            chosen = j;
    }
    return chosen;
}

void contexts_make_room_for_newest(struct contexts *contexts)
{
    int on_probation = contexts->n - contexts_count_confirmed(contexts);

    if (on_probation > CONTEXTS_ON_PROBATION || contexts->n > contexts->most + 1)
        contexts_remove_context(contexts, dispensable(contexts, true, contexts->n - 1));
}

void contexts_make_room_for_confirmed(struct contexts *contexts, int newest)
{
    while (contexts_count_confirmed(contexts) > contexts->most)
        contexts_remove_context(contexts, dispensable(contexts, false, newest));
}

int contexts_tidy(struct contexts *contexts, int winner)
{
    for (int j = contexts->n - 1; j >= 0; j--) {
        struct context *context = &contexts->context[j];
        context->age += 1.0;
        context->recent +=
            contexts_recent_share * ((j == winner ? 1.0 : contexts->h[j]) - context->recent);
        bool fitted = j != winner && contexts_distance_of(context, &contexts->fit[j]) < fits;
        context->twin = fitted ? context->twin + 1.0 : 0.0;
        bool late = !contexts_confirmed(context) && context->age > probation;
        bool twin = context->twin >= twins && context->support < contexts->context[winner].support;
        bool mistake = j != winner && context->support < fleeting && context->age > long_gone &&
                       context->recent < not_since;
        if (!late && !twin && !mistake)
            continue;
        contexts_remove_context(contexts, j);
        winner -= winner > j;
    }
    return winner;
}
