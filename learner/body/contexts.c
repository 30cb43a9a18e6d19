#include "learner/body/contexts.h"

#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/vec3.h"

/* A sample farther than this from what a context predicts (squared, in units of what it may differ)
 * is not its own: a chi-square of three has 1.4e-6 beyond. */
static const double own = 30.0;
/* One that fits this well is fitted: 1 % lies beyond. */
static const double fits = 11.3;
/* Sizes of a design whose evidence is that near to the chosen one's are believed, too. */
static const double plausible = 6.0;
static const double confirmed = 2.5;  /* samples that make a context more than a mistake */
static const double probation = 30.0; /* samples within which they must come */
static const double twins = 30.0;     /* samples in a row that make two contexts one */
/* A tool that differs by a few times the noise is within what a context may err, each sample for
 * itself; many in a row are not. Their strain grows by what their misfit exceeds `slack`. */
static const double slack = 2.0; /* of a misfit whose mean is 1 */
static const double strained = 8.0;
static const double recent_share = 0.05;
static const double least_recent = 1e-6;
static const double scale_share = 0.02;
static const double most_scale = 16.0;
static const double skipped = 1e-4; /* responsibilities under this are not learned */
/* Past that many samples, old ones fade: the tool may have slipped. */
static const double memory_samples = 2000.0;

static size_t context_numbers(const struct design *design)
{
    return tied_numbers(design) + kept_numbers(CONTEXTS_KEPT, design->n_joints, BODY_OUTPUTS);
}

/* Sizes alone: those of any body with so many joints. */
static struct design design_of(int n_joints)
{
    struct body body = {.chain = {.n = n_joints}, .length = 1.0};
    struct design design;

    design_init(&design, &body);
    return design;
}

size_t contexts_memory(int n_joints)
{
    struct design design = design_of(n_joints);
    size_t P = (size_t)design.size[2];
    size_t numbers =
        CONTEXTS_MAX * context_numbers(&design) + 6 * P + tied_scratch_numbers(&design);

    return arena_footprint(sizeof(struct contexts)) + arena_footprint(numbers * sizeof(double));
}

struct contexts *contexts_create(int n_joints, int most, const struct kernels *kernels,
                                 struct arena *arena)
{
    struct design design = design_of(n_joints);
    size_t P = (size_t)design.size[2];
    size_t each = context_numbers(&design);
    size_t numbers = CONTEXTS_MAX * each + 6 * P + tied_scratch_numbers(&design);
    struct contexts *contexts = arena_alloc(arena, sizeof *contexts);
    double *room = arena_alloc(arena, numbers * sizeof(double));

    if (!contexts || !room)
        return NULL;
    contexts->design = design;
    contexts->kernels = kernels;
    contexts->most = most < CONTEXTS_MAX ? most : CONTEXTS_MAX;
    for (size_t j = 0; j < CONTEXTS_MAX; j++) {
        struct context *context = &contexts->context[j];
        tied_place(&context->tied, &design, room + j * each);
        kept_place(&context->kept, CONTEXTS_KEPT, n_joints, BODY_OUTPUTS,
                   room + j * each + tied_numbers(&design));
    }
    contexts->rows = room + CONTEXTS_MAX * each;
    contexts->white = contexts->rows + 3 * P;
    tied_place_scratch(&contexts->scratch, &design, contexts->white + 3 * P);
    return contexts;
}

bool contexts_confirmed(const struct context *context)
{
    return context->support >= confirmed;
}

/* The sample as the regressions want it: rows and y in units of the noise, which is that of the
 * sensor and of what is not yet known of the body. */
static bool whiten_sample(struct contexts *contexts, const double *z, const double *x, double *y)
{
    const struct body *body = contexts->body;
    int P = contexts->design.size[2];
    struct chain_pose pose;
    double doubt[9] = {0};
    double white[9];
    double place[3];
    double half[9];

    if (!body_place(body, x, place, white))
        return false;
    chain_at(&body->chain, z, &pose);
    design_rows(&contexts->design, body, &pose, contexts->rows);
    body_add_doubt(body, &pose, place, x, doubt);
    mat3_multiply(white, doubt, half);
    for (int r = 0; r < 3; r++)
        for (int s = 0; s < 3; s++)
            contexts->doubt[3 * r + s] =
                vec3_dot(half + (ptrdiff_t)3 * r, white + (ptrdiff_t)3 * s);
    vec3_add(-1.0, pose.p, place);
    mat3_apply(white, place, y);
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < P; k++)
            contexts->white[r * P + k] = white[3 * r] * contexts->rows[k] +
                                         white[3 * r + 1] * contexts->rows[P + k] +
                                         white[3 * r + 2] * contexts->rows[2 * P + k];
    return true;
}

/* The least distance among the sizes that are still plausible. */
static double distance_of(const struct context *context, const struct tied_fit *fit)
{
    const struct tied *tied = &context->tied;
    double least = fit->distance[tied->chosen];

    for (int k = 0; k < DESIGN_SIZES; k++)
        if (tied->evidence[k] > tied->evidence[tied->chosen] - plausible)
            least = fmin(least, fit->distance[k]);
    return least / context->scale;
}

/* Tests the sample with every context; returns the least distance, and leaves h of those it may
 * belong to. */
static double weigh(struct contexts *contexts, const double *y)
{
    double nearest = INFINITY;
    double highest = -INFINITY;
    double sum = 0.0;

    for (int j = 0; j < contexts->n; j++) {
        struct context *context = &contexts->context[j];
        struct tied_fit *fit = &contexts->fit[j];
        tied_test(&context->tied, &contexts->design, contexts->kernels, contexts->white, y,
                  contexts->doubt, &contexts->scratch, fit);
        double distance = distance_of(context, fit);
        nearest = fmin(nearest, distance);
        contexts->log_h[j] = -INFINITY;
        if (distance <= own)
            contexts->log_h[j] = elementary_log(fmax(context->recent, least_recent)) +
                                 fit->log_density[context->tied.chosen] / context->scale;
        highest = fmax(highest, contexts->log_h[j]);
    }
    for (int j = 0; j < contexts->n; j++) {
        contexts->h[j] = highest > -INFINITY ? elementary_exp(contexts->log_h[j] - highest) : 0.0;
        sum += contexts->h[j];
    }
    for (int j = 0; j < contexts->n && sum > 0.0; j++)
        contexts->h[j] /= sum;
    return nearest;
}

/* What context j learns of the sample that has been whitened and tested. */
static void learn_in(struct contexts *contexts, int j, double h, const double *y)
{
    struct context *context = &contexts->context[j];
    double keep = context->support > memory_samples ? 1.0 - h / memory_samples : 1.0;
    double misfit = contexts->fit[j].distance[context->tied.chosen] / BODY_OUTPUTS;

    if (contexts_confirmed(context)) {
        context->scale += scale_share * h * (fmin(misfit, own) - context->scale);
        context->scale = fmin(fmax(context->scale, 1.0), most_scale);
    }
    context->support += h;
    tied_learn(&context->tied, &contexts->design, contexts->kernels, contexts->white, y, h, keep,
               &contexts->scratch, &contexts->fit[j]);
}

static void remove_context(struct contexts *contexts, int j)
{
    struct context gone = contexts->context[j];

    memmove(&contexts->context[j], &contexts->context[j + 1],
            (size_t)(contexts->n - j - 1) * sizeof gone);
    contexts->n--;
    contexts->context[contexts->n] = gone; /* its room is used again */
}

/* Who goes when there is no room: the oldest on probation, or else the confirmed one that least of
 * the newest samples were of. */
static int dispensable(const struct contexts *contexts, bool on_probation)
{
    int chosen = -1;

    for (int j = 0; j < contexts->n; j++) {
        const struct context *context = &contexts->context[j];
        const struct context *other = chosen < 0 ? NULL : &contexts->context[chosen];
        if (contexts_confirmed(context) == on_probation)
            continue;
        if (!other || (on_probation ? context->age > other->age : context->recent < other->recent))
            chosen = j;
    }
    return chosen;
}

static void make_room(struct contexts *contexts)
{
    int on_probation = 0;

    for (int j = 0; j < contexts->n; j++)
        on_probation += !contexts_confirmed(&contexts->context[j]);
    if (on_probation >= CONTEXTS_ON_PROBATION || (contexts->n == contexts->most && on_probation))
        remove_context(contexts, dispensable(contexts, true));
    else if (contexts->n == contexts->most)
        remove_context(contexts, dispensable(contexts, false));
}

/* A new context that has learned the sample alone; false when no tip could be there. */
static bool give_birth(struct contexts *contexts, const double *z, const double *x, const double *y)
{
    make_room(contexts);
    int j = contexts->n;
    struct context *context = &contexts->context[j];
    context->support = context->age = context->twin = context->strain = 0.0;
    context->recent = 0.0;
    context->scale = 1.0;
    tied_reset(&context->tied, &contexts->design);
    kept_clear(&context->kept);
    tied_test(&context->tied, &contexts->design, contexts->kernels, contexts->white, y,
              contexts->doubt, &contexts->scratch, &contexts->fit[j]);
    if (!(contexts->fit[j].distance[0] <= own))
        return false;
    contexts->n++;
    learn_in(contexts, j, 1.0, y);
    kept_add(&context->kept, z, x);
    return true;
}

/* The newest sample was context `winner`'s. Who is not needed goes. */
static void tidy(struct contexts *contexts, int winner)
{
    for (int j = contexts->n - 1; j >= 0; j--) {
        struct context *context = &contexts->context[j];
        context->age += 1.0;
        context->recent += recent_share * ((j == winner ? 1.0 : contexts->h[j]) - context->recent);
        bool fitted = j != winner && distance_of(context, &contexts->fit[j]) < fits;
        context->twin = fitted ? context->twin + 1.0 : 0.0;
        bool late = !contexts_confirmed(context) && context->age > probation;
        bool twin = context->twin >= twins && context->support < contexts->context[winner].support;
        if (!late && !twin)
            continue;
        remove_context(contexts, j);
        memmove(&contexts->fit[j], &contexts->fit[j + 1],
                (size_t)(contexts->n - j) * sizeof contexts->fit[0]);
        winner -= winner > j;
    }
}

/* Whether this sample, which is the winner's own, is one of many that fit it badly. */
static bool strains(struct contexts *contexts, int winner)
{
    struct context *context = &contexts->context[winner];
    double misfit = distance_of(context, &contexts->fit[winner]) / BODY_OUTPUTS;

    context->strain = fmax(context->strain + fmin(misfit, fits) - slack, 0.0);
    if (!contexts_confirmed(context) || context->strain < strained)
        return false;
    context->strain = 0.0;
    return true;
}

/* The sample is of none that is known: of a new one then. */
static enum learner_update_result begin_another(struct contexts *contexts, const double *z,
                                                const double *x, const double *y)
{
    if (!give_birth(contexts, z, x, y))
        return LEARNER_OUTLIER;
    for (int j = 0; j < contexts->n; j++)
        contexts->h[j] = 0.0;
    tidy(contexts, contexts->n - 1);
    return LEARNER_BORN;
}

enum learner_update_result contexts_learn(struct contexts *contexts, const double *z,
                                          const double *x)
{
    double y[BODY_OUTPUTS];
    int winner = 0;

    if (!whiten_sample(contexts, z, x, y))
        return LEARNER_OUTLIER;
    if (!(weigh(contexts, y) <= own))
        return begin_another(contexts, z, x, y);
    for (int j = 0; j < contexts->n; j++)
        if (contexts->h[j] > contexts->h[winner])
            winner = j;
    if (strains(contexts, winner)) {
        contexts->context[winner].recent *= 0.5; /* the new one is as likely */
        return begin_another(contexts, z, x, y);
    }
    for (int j = 0; j < contexts->n; j++)
        if (contexts->h[j] > skipped)
            learn_in(contexts, j, contexts->h[j], y);
    kept_add(&contexts->context[winner].kept, z, x);
    tidy(contexts, winner);
    return LEARNER_UPDATED;
}

static void relearn(struct contexts *contexts, int j)
{
    struct context *context = &contexts->context[j];
    struct kept *kept = &context->kept;
    double support = context->support;
    double y[BODY_OUTPUTS];

    tied_reset(&context->tied, &contexts->design);
    context->scale = 1.0;
    for (int i = 0; i < kept->n; i++) {
        const double *z = kept->z + (ptrdiff_t)i * kept->n_inputs;
        if (!whiten_sample(contexts, z, kept->x + (ptrdiff_t)i * BODY_OUTPUTS, y))
            continue;
        tied_test(&context->tied, &contexts->design, contexts->kernels, contexts->white, y,
                  contexts->doubt, &contexts->scratch, &contexts->fit[j]);
        learn_in(contexts, j, 1.0, y);
    }
    context->support = fmax(support, kept->n);
}

void contexts_stand_on(struct contexts *contexts, const struct body *body)
{
    contexts->body = body;
    design_init(&contexts->design, body);
    for (int j = 0; j < contexts->n; j++)
        relearn(contexts, j);
}
