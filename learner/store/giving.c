/* A body into the shadow, at the sample where the loop waits. */
#include "learner/store/store_private.h"

#include "common/program/log.h"

#include <errno.h>
#include <string.h>

void search_look_at_body(struct model_store *store)
{
    double share[LEARNER_MAX_OUTPUTS] = {0};

    learner_not_rigid(store->shadow, share);
    for (int i = 0; i < BODY_OUTPUTS; i++)
        atomic_store_explicit(&store->search.not_rigid[i], share[i], memory_order_relaxed);
}

/* Instead of what was found, or is still looked for: a body without joints. */
static void give_none(struct model_store *store)
{
    struct body_answer *answer = &store->search.answer;

    if (!store->search.forget) {
        log_warning("the body in use is given up, it explains the samples no more: %s; polynomials "
                    "go on, and the search begins anew",
                    answer->report.why);
        memset(&answer->body, 0, sizeof answer->body);
        return;
    }
    model_store_begin_with(store);
    search_end(store, MODEL_STORE_NO_SEARCH);
    memset(answer, 0, sizeof *answer);
    log_info("the body is forgotten; the search begins anew with the samples that are kept");
}

/* The body in use has changed since the search was asked for, or may have: what was found is as it
 * was before, and the samples that are kept by now are not those that it was found from. */
static bool is_late(const struct model_store *store)
{
    const struct learner_body_change change = learner_get_body_change(store->shadow);

    return !store->search.forget &&
           (change.unsettled || change.changes != store->search.changes_before);
}

static void could_not_give(struct model_store *store)
{
    search_end(store, MODEL_STORE_NOT_YET);
    model_store_set_stage(store, store->search.forget ? FAILED : FREE);
    store->search.forget = false;
}

void model_store_give_body(struct model_store *store, int64_t now)
{
    const struct search *search = &store->search;
    char why[200];

    if (store->shadow_number != search->at)
        return;
    if (is_late(store)) {
        log_info("the body may have changed while it was searched for; the search begins anew");
        atomic_store_explicit(&store->search.again, true, memory_order_release);
        could_not_give(store);
        return;
    }
    if (search_gives_none(search))
        give_none(store);
    if (model_store_lock_shadow(store)) {
        log_error("cannot lock memory for a body: %s; raise LimitMEMLOCK", strerror(errno));
    } else if (learner_give_body(store->shadow, &search->answer.body, why, sizeof why)) {
        log_error("the body that was found is of no use: %s", why);
    } else {
        model_store_keep_body(store, now);
        model_capture(&store->model, store->shadow);
        atomic_store_explicit(&store->search.outcome,
                              search_gives_none(search) ? MODEL_STORE_NO_SEARCH : MODEL_STORE_FOUND,
                              memory_order_relaxed);
        search_look_at_body(store);
        model_store_set_stage(store, BODY_GIVEN);
        return;
    }
    could_not_give(store);
}
