/* A change that was noticed goes into the body, and into what was learned before it. */
#include <string.h>

#include "learner/body/chain/vec3.h"
#include "learner/body/contexts/follow.h"
#include "learner/body/contexts/population.h"

const double follow_fewest_own = 200.0;

/* What is left of y with the remembered tip. */
void follow_left_of(const struct contexts *contexts, const struct anchor *anchor, const double *y,
                    double *left)
{
    ptrdiff_t P = contexts->design.size[2];

    for (int r = 0; r < 3; r++)
        left[r] =
            y[r] - contexts->kernels->dot(anchor->size, contexts->white + r * P, anchor->theta);
}

void follow_end_streak(struct contexts *contexts)
{
    contexts->streak = contexts->streak_left = 0.0;
    for (int j = 0; j < contexts->n; j++)
        change_clear(&contexts->context[j].anchor.astray, contexts->design.n_joints);
}

/* Whether a sample of a tool in use was taken before the change: its remembered tip explains it as
 * it is, rather than with the change. */
static bool of_before(struct contexts *contexts, const struct anchor *anchor,
                      const struct change_story *story, const double *z, const double *x)
{
    int m = change_columns(contexts->design.n_joints);
    int count = story->cause < contexts->design.n_joints ? 1 : CHANGE_VIEW;
    double rows[3 * CHANGE_MAX];
    double left[3];
    double y[3];

    if (!contexts_whiten(contexts, z, x, y) ||
        !change_rows(contexts->body, &contexts->pose, contexts->place, x, contexts->by_noise, rows))
        return true;
    follow_left_of(contexts, anchor, y, left);
    double before = vec3_length(left);
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < count; k++)
            left[r] -= rows[r * m + story->cause + k] * story->c[k];
    return before <= vec3_length(left);
}

/* Samples of before the change, as they would be seen now. */
static void rewrite_kept(struct contexts *contexts, struct context *context,
                         const struct change_story *story, bool in_use)
{
    struct kept *kept = &context->kept;

    for (int i = 0; i < kept->n; i++) {
        double *z = kept->z + (ptrdiff_t)i * kept->n_inputs;
        double *x = kept->x + (ptrdiff_t)i * BODY_OUTPUTS;
        if (!in_use || of_before(contexts, &context->anchor, story, z, x))
            change_sample(story, contexts->body, z, x);
    }
}

static void correct_context(struct contexts *contexts, struct context *context, bool astray,
                            const struct change_story *story)
{
    struct anchor *anchor = &context->anchor;
    bool in_use = anchor->known && anchor->own.weight >= follow_fewest_own && !astray;

    rewrite_kept(contexts, context, story, in_use);
    if (in_use) /* it has followed the change by its tip */
        tied_set(&context->tied, &contexts->design, contexts->kernels, anchor->theta,
                 &contexts->scratch);
    context->strain = 0.0;
    context->slip = 0.0;
    if (!anchor->known)
        return;
    anchor->slips = false;
    change_clear(&anchor->own, contexts->design.n_joints);
    change_clear(&anchor->astray, contexts->design.n_joints);
}

static void tell(struct contexts *contexts, const struct change_story *story)
{
    struct body_news *news = &contexts->news;
    int count = story->cause < contexts->design.n_joints ? 1 : CHANGE_VIEW;

    if (story->cause != news->cause)
        memset(news->by, 0, sizeof news->by);
    news->changes += 1.0;
    news->cause = story->cause;
    for (int k = 0; k < count; k++)
        news->by[k] += story->c[k] * change_unit(contexts->body, story->cause + k);
}

/* Contexts born of what was not understood were of the tool that is understood now. */
void follow_correct(struct contexts *contexts, int astray, const struct change_story *story)
{
    double streak = contexts->streak + 1.0;

    tell(contexts, story);
    for (int j = 0; j < contexts->n; j++)
        correct_context(contexts, &contexts->context[j], j == astray, story);
    change_apply(story, contexts->body);
    follow_end_streak(contexts);
    if (astray < 0)
        return;
    contexts->context[astray].recent = 1.0;
    for (int j = contexts->n - 1; j >= 0; j--)
        if (!contexts->context[j].anchor.known && contexts->context[j].age <= streak)
            contexts_remove_context(contexts, j);
}
