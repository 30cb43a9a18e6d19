/* A body that explains its samples badly is on trial beside the mixture of polynomials. */
#include <math.h>
#include <string.h>

#include "learner/body/body_learner.h"
#include "learner/body/chain/order.h"
#include "learner/body/search/search.h"
#include "learner/kind.h"

/* Misfits that large, in units of the noise told, may be those of no chain. */
static const double doubtful_error = 3.0;
static const double hysteresis = 0.5;

/* How far the nearest of all solutions is, squared, a coordinate, in units of the noise told. */
static double square_of(const struct body_learner *learner,
                        const struct learner_prediction *prediction, const double *x)
{
    struct finder_settings told = finder_settings_of(&learner->config);
    double least = INFINITY;

    for (int s = 0; s < prediction->n_solutions; s++) {
        double sum = 0.0;
        for (int r = 0; r < BODY_OUTPUTS; r++) {
            double off = (prediction->solution[s].value[r] - x[r]) / told.noise[r];
            sum += off * off / BODY_OUTPUTS;
        }
        least = fmin(least, sum);
    }
    return least;
}

/* The body is off by what the finder said of it, times what the tool in use says since. */
static bool explains_badly(const struct body_learner *learner)
{
    const struct contexts *contexts = learner->contexts;
    const struct context *in_use = NULL;

    for (int j = 0; j < contexts->n; j++)
        if (!in_use || contexts->context[j].recent > in_use->recent)
            in_use = &contexts->context[j];
    return learner->body.error * sqrt(in_use ? in_use->scale : 1.0) > doubtful_error;
}

static void give_up(struct body_learner *learner)
{
    const struct contest *contest = &learner->contest;

    /* What the finder says of a body is seen in samples near those that it has: the next one's word
     * is worth as much as this one's was. */
    learner->given_up = hysteresis * contest->polynomial / contest->body * learner->body.error *
                        learner->body.error;
    learner->found = learner->doubtful = false;
    contexts_forget(learner->contexts);
    learner->contest = contest_begin();
}

void body_begin_trial(struct body_learner *learner, const struct body *body)
{
    bool was_doubtful = learner->doubtful;

    learner->doubtful = body->error > doubtful_error;
    if (!learner->doubtful)
        imle_forget(learner->meanwhile); /* it has answered for the last time */
    if (!learner->doubtful || !was_doubtful)
        learner->contest = contest_begin();
}

bool body_try(struct body_learner *learner, const double *z, const double *x)
{
    struct contest *contest = &learner->contest;
    struct learner_prediction *scratch = &learner->scratch;
    double polynomial = INFINITY;
    double body = INFINITY;

    learner->doubtful = learner->doubtful || explains_badly(learner);
    if (!learner->doubtful)
        return false;
    bool withheld = contest_withholds(contest);
    if (contest_counts(contest)) {
        scratch->n_solutions = imle_predict(learner->meanwhile, z, scratch);
        polynomial = square_of(learner, scratch, x);
        scratch->n_solutions = 0;
        learner_body_ops.predict(learner, z, scratch);
        body = square_of(learner, scratch, x);
    }
    if (!withheld) {
        double joints[LEARNER_MAX_INPUTS];
        imle_learn(learner->meanwhile, z, x);
        order_to_chain(&learner->config, z, joints);
        kept_add(&learner->waiting, joints, x);
    }
    contest_add(contest, polynomial, body);
    if (contest_lost(contest))
        give_up(learner);
    return withheld;
}
