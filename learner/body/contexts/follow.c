#include "learner/body/contexts/follow.h"

#include <math.h>
#include <string.h>

#include "learner/body/chain/vec3.h"
#include "learner/body/contexts/population.h"

static const double first_remembered = 200.0; /* samples of a context */
static const double memory_own = 500.0;       /* samples that weigh on a slow change */
static const double memory_astray = 50.0;     /* and on a sudden one */
static const double fewest_astray = 15.0;
static const double decided = 60.0; /* samples, after which a change was seen or is none */
/* A change is told when it is that much likelier than every other story, log, */
static const double convincing = 25.0;
static const double quiet = 10.0;        /* under this nothing speaks for any */
static const double least_effect = 0.7;  /* of the noise: it is seen, */
static const double astray_effect = 2.0; /* the same where samples are not understood, */
static const double curved = 0.05;       /* of the effect, which is linear for small ones alone */
static const double most_left = 1.2;     /* and when it leaves little more than that */
static const double most_doubt = 1.0;    /* of the body, over the noise */
static const double slipped = 1.0;       /* how far a tip may slip, and a new tool's */
static const double anywhere = 15.0;     /* be elsewhere, over change_unit() */

enum { LOOK_EACH = 16, LOOK_EACH_ASTRAY = 4 };

static void take_tip(const struct contexts *contexts, struct context *context)
{
    struct anchor *anchor = &context->anchor;
    const struct tied *tied = &context->tied;

    anchor->size = contexts->design.size[tied->chosen];
    memset(anchor->theta, 0, (size_t)contexts->design.size[2] * sizeof *anchor->theta);
    memcpy(anchor->theta, tied->theta[tied->chosen], (size_t)anchor->size * sizeof(double));
}

static void remember(struct contexts *contexts, struct context *context)
{
    struct anchor *anchor = &context->anchor;

    take_tip(contexts, context);
    anchor->known = true;
    anchor->next = 2.0 * fmax(context->support, first_remembered);
    change_clear(&anchor->own, contexts->design.n_joints);
    change_clear(&anchor->astray, contexts->design.n_joints);
}

static bool any_remembered(const struct contexts *contexts)
{
    for (int j = 0; j < contexts->n; j++)
        if (contexts->context[j].anchor.known)
            return true;
    return false;
}

static void count_streak(struct contexts *contexts, bool understood)
{
    if (!understood && any_remembered(contexts))
        contexts->streak_left = memory_astray;
    if (contexts->streak_left <= 0.0)
        return;
    contexts->streak += 1.0;
    contexts->streak_left -= 1.0;
    if (contexts->streak_left <= 0.0)
        follow_end_streak(contexts);
}

void follow_sample(struct contexts *contexts, int winner, const double *x, const double *y)
{
    const struct contexts *c = contexts;
    int n = contexts->design.n_joints;
    double rows[3 * CHANGE_MAX];
    double left[3];
    bool understood = winner >= 0 && contexts->context[winner].anchor.known;

    contexts->looked += 1.0;
    count_streak(contexts, understood);
    if (c->doubt[0] + c->doubt[4] + c->doubt[8] > 3.0 * most_doubt ||
        (!understood && contexts->streak_left <= 0.0) ||
        !change_rows(contexts->body, &contexts->pose, contexts->place, x, contexts->by_noise, rows))
        return;
    for (int j = 0; j < contexts->n; j++) {
        struct context *context = &contexts->context[j];
        struct anchor *anchor = &context->anchor;
        bool own = j == winner && contexts->h[j] > 0.5;
        if (!anchor->known || (!own && contexts->streak_left <= 0.0))
            continue;
        follow_left_of(contexts, anchor, y, left);
        if (own)
            change_add(&anchor->own, n, rows, left, context->scale, 1.0 - 1.0 / memory_own);
        if (contexts->streak_left > 0.0)
            change_add(&anchor->astray, n, rows, left, context->scale, 1.0 - 1.0 / memory_astray);
    }
}

/* What contexts' own samples say. `slips`: tips that have slipped before may have slipped; `slow`:
 * those that show no change are asked, too, which a sudden change makes old. */
static int gather(const struct contexts *contexts, bool slips, bool slow, struct change_case *cases)
{
    int n_cases = 0;

    for (int j = 0; j < contexts->n; j++) {
        const struct anchor *anchor = &contexts->context[j].anchor;
        if (anchor->known && anchor->own.weight >= follow_fewest_own && (slow || anchor->slips))
            cases[n_cases++] =
                (struct change_case){&anchor->own, slips && anchor->slips ? slipped : 0.0};
    }
    return n_cases;
}

static double gain_of_slip(const struct contexts *contexts, const struct change_sums *sums,
                           double moved)
{
    const struct change_case one = {sums, moved};
    struct change_story story;

    change_explain(&one, 1, contexts->design.n_joints, -1, &story);
    return story.gain;
}

/* Whether tips slip. Returns how much speaks for it, log. */
static double look_at_slips(struct contexts *contexts)
{
    int n = contexts->design.n_joints;
    double unit = change_unit(contexts->body, n + CHANGE_VIEW);
    double gain = 0.0;
    double moved[3];

    for (int j = 0; j < contexts->n; j++) {
        struct context *context = &contexts->context[j];
        struct anchor *anchor = &context->anchor;
        if (!anchor->known || anchor->own.weight < follow_fewest_own)
            continue;
        double of_tip = gain_of_slip(contexts, &anchor->own, slipped);
        double effect = change_of_tip(&anchor->own, n, moved);
        gain += fmax(of_tip, 0.0);
        anchor->slips = of_tip > convincing && effect > least_effect;
        context->slip = anchor->slips ? unit * vec3_length(moved) : 0.0;
    }
    return gain;
}

/* The story is seen, and explains all of the cases; the last is of samples that are astray. */
static bool holds(const struct contexts *contexts, const struct change_case *cases, int n_cases,
                  bool astray, const struct change_story *story)
{
    int n = contexts->design.n_joints;
    double effect = 0.0;
    double most = 0.0;

    for (int k = 0; k < n_cases; k++) {
        effect = change_effect(&cases[k], n, story);
        if (change_left(&cases[k], n, story) > most_left + curved * effect)
            return false;
        most = fmax(most, effect);
    }
    return astray ? effect > astray_effect : most > least_effect;
}

/* Tries every cause on what contexts' own samples say, and on the newest ones where they are astray
 * (NULL: there are none), against tips alone, each for itself. A better one that holds takes the
 * place of `best`. */
static bool try_causes(const struct contexts *contexts, const struct change_sums *astray,
                       bool may_slip, struct change_story *best)
{
    struct change_case cases[CONTEXTS_ROOM + 1];
    int n = contexts->design.n_joints;
    int n_cases = gather(contexts, may_slip, !astray, cases);
    bool better = false;
    double other = 0.0;

    for (int k = 0; k < n_cases; k++)
        other += fmax(gain_of_slip(contexts, cases[k].sums, slipped), 0.0);
    if (astray) {
        other += fmax(gain_of_slip(contexts, astray, anywhere), 0.0);
        cases[n_cases++] = (struct change_case){astray, 0.0};
    }
    for (int cause = 0; cause <= n; cause++) {
        struct change_story story;
        change_explain(cases, n_cases, n, cause, &story);
        story.gain -= other;
        if (!(story.gain > best->gain) || !holds(contexts, cases, n_cases, astray, &story))
            continue;
        *best = story;
        better = true;
    }
    return better;
}

/* A tool that was remembered, and of which the newest samples are once the body has changed; -1 for
 * none. */
static int look_at_astray(const struct contexts *contexts, struct change_story *best)
{
    int found = -1;

    for (int j = 0; j < contexts->n; j++) {
        const struct anchor *anchor = &contexts->context[j].anchor;
        if (!anchor->known || anchor->astray.weight < fewest_astray)
            continue;
        bool firm = try_causes(contexts, &anchor->astray, false, best);
        if (try_causes(contexts, &anchor->astray, true, best) || firm)
            found = j;
    }
    return found;
}

/* What contexts that are not in use have said speaks of another time. */
static void fade(struct contexts *contexts, double samples)
{
    for (int j = 0; j < contexts->n; j++) {
        struct anchor *anchor = &contexts->context[j].anchor;
        if (anchor->known && contexts->h[j] < 0.5)
            change_fade(&anchor->own, contexts->design.n_joints, 1.0 - samples / memory_own);
    }
}

/* Tips that have stayed where they were are known better by now. */
static void remember_again(struct contexts *contexts, double gain)
{
    for (int j = 0; j < contexts->n; j++) {
        struct context *context = &contexts->context[j];
        const struct anchor *anchor = &context->anchor;
        bool first = contexts_confirmed(context) && context->support >= first_remembered;
        bool again = gain < quiet && context->support >= anchor->next;
        if (anchor->known ? again : first)
            remember(contexts, context);
    }
}

bool follow_look(struct contexts *contexts)
{
    struct change_story best = {.cause = -1, .gain = convincing};
    bool astray = contexts->streak_left > 0.0;

    if (!contexts->firm || contexts->looked < (astray ? LOOK_EACH_ASTRAY : LOOK_EACH))
        return false;
    fade(contexts, contexts->looked);
    contexts->looked = 0.0;
    double by_slips = look_at_slips(contexts);
    int winner = astray ? look_at_astray(contexts, &best) : -1;
    bool firm = try_causes(contexts, NULL, false, &best);
    if (try_causes(contexts, NULL, true, &best) || firm)
        winner = -1;
    if (best.cause < 0) {
        remember_again(contexts, by_slips);
        return false;
    }
    follow_correct(contexts, winner, &best);
    return true;
}

bool follow_unsettled(const struct contexts *contexts)
{
    return contexts->streak_left > 0.0 && contexts->streak < decided;
}

/* Where the tip is in the frame of one body is elsewhere in that of another: the same samples,
 * learned on both, say by how much. */
static void shift_tip(struct context *context, double step)
{
    for (int k = 0; k < DESIGN_TIP; k++)
        context->anchor.theta[k] += step * context->tied.theta[0][k];
}

bool follow_leaves(struct context *context)
{
    return context->anchor.known && context->anchor.slips;
}

void follow_left(struct context *context)
{
    shift_tip(context, -1.0);
}

void follow_relearned(struct contexts *contexts, struct context *context)
{
    if (follow_leaves(context))
        shift_tip(context, 1.0);
    else if (context->anchor.known)
        remember(contexts, context);
}
