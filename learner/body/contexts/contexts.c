#include "learner/body/contexts/population.h"

#include <math.h>
#include <string.h>

#include "common/base/elementary.h"
#include "learner/body/chain/vec3.h"
#include "learner/body/contexts/follow.h"

/* A sample farther than this from what a context predicts (squared, in units of what it may differ)
 * is not its own: a chi-square of three has 1.4e-6 beyond. */
static const double own = 30.0;
/* How much better than a tip that could be anywhere a tip that gives way must foretell a sample for
 * that to be the simpler story, log. */
static const double foretold = 4.0;
static const double least_recent = 1e-6;
static const double scale_share = 0.02;
static const double most_scale = 16.0;
static const double skipped = 1e-4; /* responsibilities under this are not learned */
/* Past that many samples, old ones fade: the tool may have slipped. */
static const double memory_samples = 2000.0;
static const double memory_of_slipping = 300.0;
static const double of_slipping = 600.0; /* samples, of which kept ones still are where it is */

static size_t context_numbers(const struct design *design)
{
    return tied_numbers(design) + kept_numbers(CONTEXTS_KEPT, design->n_joints, BODY_OUTPUTS) +
           contexts_anchor_numbers(design);
}

size_t contexts_anchor_numbers(const struct design *design)
{
    return (size_t)design->size[2] + 2 * change_sums_numbers(design->n_joints);
}

static void place_anchor(struct anchor *anchor, const struct design *design, double *numbers)
{
    anchor->theta = numbers;
    change_place(&anchor->own, design->n_joints, numbers + design->size[2]);
    change_place(&anchor->astray, design->n_joints,
                 numbers + design->size[2] + change_sums_numbers(design->n_joints));
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
        CONTEXTS_ROOM * context_numbers(&design) + 6 * P + tied_scratch_numbers(&design);

    return arena_footprint(sizeof(struct contexts)) + arena_footprint(numbers * sizeof(double));
}

struct contexts *contexts_create(struct body *body, int n_joints, int most,
                                 const struct kernels *kernels, struct arena *arena)
{
    struct design design = design_of(n_joints);
    size_t P = (size_t)design.size[2];
    size_t each = context_numbers(&design);
    size_t numbers = CONTEXTS_ROOM * each + 6 * P + tied_scratch_numbers(&design);
    struct contexts *contexts = arena_alloc(arena, sizeof *contexts);
    double *room = arena_alloc(arena, numbers * sizeof(double));

    if (!contexts || !room)
        return NULL;
    contexts->body = body;
    contexts->design = design;
    contexts->kernels = kernels;
    contexts->most = most < CONTEXTS_MAX ? most : CONTEXTS_MAX;
    for (size_t j = 0; j < CONTEXTS_ROOM; j++) {
        struct context *context = &contexts->context[j];
        tied_place(&context->tied, &design, room + j * each);
        kept_place(&context->kept, CONTEXTS_KEPT, n_joints, BODY_OUTPUTS,
                   room + j * each + tied_numbers(&design));
        place_anchor(&context->anchor, &design,
                     room + (j + 1) * each - contexts_anchor_numbers(&design));
    }
    contexts->news.cause = -1;
    contexts->rows = room + CONTEXTS_ROOM * each;
    contexts->white = contexts->rows + 3 * P;
    tied_place_scratch(&contexts->scratch, &design, contexts->white + 3 * P);
    return contexts;
}

/* Squares of joints farther off lose the digits of everything else. */
static bool within_sense(const struct design *design, const struct body *body, const double *z)
{
    const double farthest = 300.0; /* of a joint's range */

    for (int i = 0; i < design->n_joints; i++)
        if (!(fabs(z[i] - body->chain.middle[i]) <= farthest * design->range[i]))
            return false;
    return true;
}

bool contexts_whiten(struct contexts *contexts, const double *z, const double *x, double *y)
{
    const struct body *body = contexts->body;
    int P = contexts->design.size[2];
    struct chain_pose *pose = &contexts->pose;
    double *white = contexts->by_noise;
    double doubt[9] = {0};
    double apart[3];
    double half[9];

    if (!body_place(body, x, contexts->place, white))
        return false;
    chain_at(&body->chain, z, pose);
    design_rows(&contexts->design, body, pose, contexts->rows);
    body_add_doubt(body, pose, contexts->place, x, doubt);
    mat3_multiply(white, doubt, half);
    for (int r = 0; r < 3; r++)
        for (int s = 0; s < 3; s++)
            contexts->doubt[3 * r + s] =
                vec3_dot(half + (ptrdiff_t)3 * r, white + (ptrdiff_t)3 * s);
    memcpy(apart, contexts->place, sizeof apart);
    vec3_add(-1.0, pose->p, apart);
    mat3_apply(white, apart, y);
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < P; k++)
            contexts->white[r * P + k] = white[3 * r] * contexts->rows[k] +
                                         white[3 * r + 1] * contexts->rows[P + k] +
                                         white[3 * r + 2] * contexts->rows[2 * P + k];
    return true;
}

/* How much better a context foretells the sample than a tip that could be anywhere. */
static double gain_of(const struct context *context, const struct tied_fit *fit, double fresh)
{
    const struct tied *tied = &context->tied;
    double before = -INFINITY;
    double after = -INFINITY;

    for (int k = 0; k < DESIGN_SIZES; k++) {
        before = fmax(before, tied->evidence[k]);
        after = fmax(after, tied->evidence[k] + fit->log_density[k]);
    }
    return after - before - fresh;
}

/* Tests the sample with every context; returns the least distance, and leaves h of those it may
 * belong to. */
static double weigh(struct contexts *contexts, const double *y)
{
    double fresh = tied_fresh_log_density(&contexts->design, contexts->white, y, contexts->doubt);
    double nearest = INFINITY;
    double highest = -INFINITY;
    double sum = 0.0;

    for (int j = 0; j < contexts->n; j++) {
        struct context *context = &contexts->context[j];
        struct tied_fit *fit = &contexts->fit[j];
        tied_test(&context->tied, &contexts->design, contexts->kernels, contexts->white, y,
                  contexts->doubt, &contexts->scratch, fit);
        double distance = contexts_distance_of(context, fit);
        contexts->log_h[j] = -INFINITY;
        contexts->gain[j] = gain_of(context, fit, fresh);
        if (!contexts_confirmed(context) && contexts->gain[j] < 0.0)
            continue; /* a tool of its own is the better explanation */
        nearest = fmin(nearest, distance);
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
    double memory = context->anchor.slips ? memory_of_slipping : memory_samples;
    double keep = context->support > memory ? 1.0 - h / memory : 1.0;
    double misfit = contexts->fit[j].distance[context->tied.chosen] / BODY_OUTPUTS;

    if (contexts_confirmed(context)) {
        context->scale += scale_share * h * (fmin(misfit, own) - context->scale);
        context->scale = fmin(fmax(context->scale, 1.0), most_scale);
    } else {
        context->gain += h * contexts->gain[j];
    }
    context->support += h;
    contexts_try(context);
    tied_learn(&context->tied, &contexts->design, contexts->kernels, contexts->white, y, h, keep,
               &contexts->scratch, &contexts->fit[j]);
}

/* A new context that has learned the sample alone; false when no tip could be there. */
static bool give_birth(struct contexts *contexts, const double *z, const double *x, const double *y)
{
    int j = contexts->n;
    struct context *context = &contexts->context[j];

    contexts_begin(contexts, j);
    tied_test(&context->tied, &contexts->design, contexts->kernels, contexts->white, y,
              contexts->doubt, &contexts->scratch, &contexts->fit[j]);
    if (!(contexts->fit[j].distance[0] <= own))
        return false;
    contexts->n++;
    contexts->births += 1.0;
    learn_in(contexts, j, 1.0, y);
    kept_add(&context->kept, z, x);
    contexts_make_room_for_newest(contexts);
    return true;
}

/* What one of the contexts explains, which has most of it. Where that is one on probation, and its
 * tip would have to give way, the sample may as well be of another tool: both are tried. */
static void learn_known(struct contexts *contexts, int winner, const double *z, const double *x,
                        const double *y)
{
    for (int j = 0; j < contexts->n; j++)
        if (contexts->h[j] > skipped)
            learn_in(contexts, j, contexts->h[j], y);
    kept_add(&contexts->context[winner].kept, z, x);
    bool told_apart = contexts_confirmed(&contexts->context[winner]) ||
                      contexts->fit[winner].distance[0] <= own || contexts->gain[winner] > foretold;
    contexts_make_room_for_confirmed(contexts, contexts_tidy(contexts, winner));
    if (!told_apart)
        give_birth(contexts, z, x, y);
}

/* The newest context was born of what the others did not explain. One on probation that is made of
 * gross errors explains by chance what it takes: what it could not take counts against it. */
static void doubt_others(struct contexts *contexts)
{
    const double most = 5.0;

    for (int j = 0; j < contexts->n; j++) {
        contexts->h[j] = 0.0;
        if (!contexts_confirmed(&contexts->context[j]) && j < contexts->n - 1)
            contexts->context[j].gain += fmax(fmin(contexts->gain[j], 0.0), -most);
    }
}

static int most_responsible(const struct contexts *contexts)
{
    int winner = 0;

    for (int j = 0; j < contexts->n; j++)
        if (contexts->h[j] > contexts->h[winner])
            winner = j;
    return winner;
}

enum learner_update_result contexts_learn(struct contexts *contexts, const double *z,
                                          const double *x)
{
    double y[BODY_OUTPUTS];

    if (!within_sense(&contexts->design, contexts->body, z))
        return LEARNER_REFUSED;
    if (!contexts_whiten(contexts, z, x, y))
        return LEARNER_OUTLIER;
    if (weigh(contexts, y) <= own) {
        int winner = most_responsible(contexts);
        if (!contexts_strained(contexts, winner)) {
            follow_sample(contexts, winner, x, y);
            learn_known(contexts, winner, z, x, y);
            follow_look(contexts);
            return LEARNER_UPDATED;
        }
        contexts->context[winner].recent *= 0.5; /* the new one is as likely */
    }
    follow_sample(contexts, -1, x, y);
    if (!give_birth(contexts, z, x, y))
        return LEARNER_OUTLIER;
    doubt_others(contexts);
    contexts_tidy(contexts, contexts->n - 1);
    follow_look(contexts);
    return LEARNER_BORN;
}

static void relearn(struct contexts *contexts, int j)
{
    struct context *context = &contexts->context[j];
    struct kept *kept = &context->kept;
    double oldest = follow_leaves(context) ? kept->offered - of_slipping : 0.0;
    double support = context->support;
    double y[BODY_OUTPUTS];
    bool any = false;

    tied_reset(&context->tied, &contexts->design, NULL);
    contexts->gain[j] = 0.0;
    context->scale = 1.0;
    for (int i = 0; i < kept->n; i++) {
        const double *z = kept->z + (ptrdiff_t)i * kept->n_inputs;
        if (kept->at[i] < oldest ||
            !contexts_whiten(contexts, z, kept->x + (ptrdiff_t)i * BODY_OUTPUTS, y))
            continue;
        if (!any)
            contexts_hold(contexts, j);
        any = true;
        tied_test(&context->tied, &contexts->design, contexts->kernels, contexts->white, y,
                  contexts->doubt, &contexts->scratch, &contexts->fit[j]);
        learn_in(contexts, j, 1.0, y);
    }
    context->support = fmax(support, kept->n);
}

void contexts_forget(struct contexts *contexts)
{
    contexts->n = 0;
    contexts->streak = contexts->streak_left = contexts->looked = 0.0;
    contexts->news = (struct body_news){.cause = -1};
}

void contexts_stand_on(struct contexts *contexts, const struct body *body)
{
    for (int j = 0; j < contexts->n; j++)
        if (follow_leaves(&contexts->context[j])) {
            relearn(contexts, j);
            follow_left(&contexts->context[j]);
        }
    *contexts->body = *body;
    contexts->streak = contexts->streak_left = 0.0;
    design_init(&contexts->design, body);
    for (int j = 0; j < contexts->n; j++) {
        relearn(contexts, j);
        follow_relearned(contexts, &contexts->context[j]);
    }
    contexts_make_room_for_confirmed(contexts, -1);
}
