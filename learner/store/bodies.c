/* Bodies on their way: a search that is due, the request for it, its answer, and the body into the
 * shadow. */
#include "learner/store/store_private.h"

#include "common/program/log.h"

#include <string.h>

static const int64_t first_patience_us = 3000000; /* until somebody says that the request came */
static const int64_t next_patience_us = 300000;   /* the same, once nobody did */
static const int64_t again_us = 500000;           /* a request may have been lost, */
static const int64_t answer_us = 5000000;         /* or, once it came, its answer */
static const double degrees = 57.29577951308232;
static const int64_t search_us = 60000000; /* for the search itself */

bool model_store_seeks(const struct model_store_settings *settings)
{
    return settings->finder && settings->learner.kind == LEARNER_IMLE &&
           settings->learner.features == LEARNER_BODY;
}

void model_store_search_anew(struct model_store *store, const struct learner *learner)
{
    store->search.schedule = body_schedule_begin();
    body_schedule_searched(&store->search.schedule, learner);
}

void model_store_learned(struct model_store *store, const struct learner *learner)
{
    struct search *search = &store->search;

    if (!model_store_seeks(&store->settings) || search_stage_of(store) != SEARCH_NONE)
        return;
    if (atomic_exchange_explicit(&search->again, false, memory_order_acquire))
        search->schedule = body_schedule_begin();
    if (!body_schedule_due(&search->schedule, learner))
        return;
    body_schedule_searched(&search->schedule, learner);
    search->seq++;
    search->epoch = store->epoch;
    search->at = store->number;
    search_set_stage(store, SEARCH_ASKED);
}

void model_store_begin_forgetting(struct model_store *store)
{
    store->search.forget = true;
}

void model_store_tell_body(struct model_store *store)
{
    atomic_store_explicit(&store->search.tell, true, memory_order_release);
}

/* The loop has nothing else under way, and housekeeping has a body for it, or it wants none. */
static bool may_await(const struct model_store *store)
{
    return model_store_stage(store) == FREE &&
           (store->search.forget || search_stage_of(store) == SEARCH_FOUND);
}

/* What housekeeping gave the shadow, as the trace has it. */
static void note_given(struct model_store *store)
{
    struct model_store_moment *moment = &store->moment;
    struct search *search = &store->search;

    if (!search_gives_none(search)) {
        moment->body = search->seq;
        moment->body_checksum = search->answer.checksum;
        search_set_stage(store, SEARCH_NONE);
        return;
    }
    moment->body = MODEL_STORE_BODY_TAKEN;
    if (search->forget)
        moment->result = MODEL_STORE_DONE;
    search->forget = false;
    search->schedule = body_schedule_begin();
    search_set_stage(store, SEARCH_NONE);
}

bool model_store_poll_body(struct model_store *store, bool *awaited)
{
    struct model_store_moment *moment = &store->moment;

    moment->body = 0;
    moment->body_checksum = 0;
    *awaited = false;
    if (model_store_stage(store) == BODY_GIVEN) {
        note_given(store);
        return true;
    }
    if (!may_await(store))
        return false;
    *awaited = true;
    store->search.at = store->number;
    model_store_set_stage(store, BODY_AWAITED);
    return false;
}

void model_store_begin_with(struct model_store *store)
{
    store->search.any_candidate = store->settings.start != NULL;
    if (store->settings.start)
        store->search.candidate = *store->settings.start;
}

void model_store_drop_search(struct model_store *store)
{
    model_store_begin_with(store);
    if (search_stage_of(store) != SEARCH_NONE)
        search_end(store, MODEL_STORE_NO_SEARCH);
}

void model_store_search_if_reached(struct model_store *store, int64_t now)
{
    struct search *search = &store->search;
    struct body_search wanted = {.settings = finder_settings_of(&store->settings.learner)};

    if (search_stage_of(store) != SEARCH_ASKED)
        return;
    if (search->epoch != store->shadow_epoch) {
        model_store_drop_search(store);
        return;
    }
    if (store->shadow_number != search->at)
        return;
    wanted.seq = wanted.settings.seed = search->seq;
    wanted.settings.start = learner_body(store->shadow);
    if (!wanted.settings.start && search->any_candidate)
        wanted.settings.start = &search->candidate;
    wanted.n_contexts = body_schedule_samples(store->shadow, wanted.contexts);
    search->sent_at = search->asked_at = now;
    search->came = false;
    search->changes_before = learner_get_body_change(store->shadow).changes;
    store->settings.finder->ask(store->settings.finder->user, &wanted);
    search_set_stage(store, SEARCH_SENT);
}

static void say_found(const struct body_answer *answer)
{
    log_info("a body was found from %d samples in %.2f s: off by %.2f times the noise on samples "
             "kept apart, unsure by %.2f %% of its length",
             answer->report.samples, answer->seconds, answer->report.error,
             100 * answer->report.doubt);
}

/* What the next search may begin with: never a body that was refuted, after which it begins as the
 * first one did. */
static void keep_candidate(struct model_store *store)
{
    struct search *search = &store->search;
    const struct finder_report *report = &search->answer.report;

    if (report->outcome == FINDER_REFUTED)
        model_store_begin_with(store);
    if (!report->any_body)
        return;
    search->any_candidate = true;
    search->candidate = search->answer.body;
}

static void take_report(struct model_store *store)
{
    const struct body_answer *answer = &store->search.answer;

    switch (answer->report.outcome) {
    case FINDER_FOUND:
        say_found(answer);
        search_set_stage(store, SEARCH_FOUND);
        break;
    case FINDER_REFUTED:
        keep_candidate(store);
        if (learner_body(store->shadow))
            search_set_stage(store, SEARCH_FOUND);
        else
            search_end(store, MODEL_STORE_NOT_YET);
        break;
    case FINDER_NOT_YET:
        keep_candidate(store);
        log_debug("no body yet: %s", answer->report.why);
        search_end(store, MODEL_STORE_NOT_YET);
        break;
    default:
        log_info("no body: %s", answer->report.why);
        search_end(store, MODEL_STORE_NO_CHAIN);
        break;
    }
}

static void say_changed(struct model_store *store)
{
    const struct learner_body_change change = learner_get_body_change(store->shadow);
    uint64_t known = store->search.changes;

    store->search.changes = change.changes;
    if (change.changes <= known)
        return;
    if (change.cause < store->settings.learner.n_inputs)
        log_info("the body has changed: the zero of joint %d by %.2f deg; followed",
                 change.cause + 1, change.by[0] * degrees);
    else
        log_info("the view has changed: by %.3g %.3g %.3g; followed", change.by[0], change.by[1],
                 change.by[2]);
}

static void take_answer(struct model_store *store)
{
    struct search *search = &store->search;

    if (search_stage_of(store) != SEARCH_SENT || search->answer.seq != search->seq)
        return; /* of a search that is over */
    search->came = true;
    search->absent = false;
    if (search->answer.kind == BODY_ANSWER_REPORT) {
        search_look_at_body(store);
        take_report(store);
    } else if (search->answer.kind == BODY_ANSWER_REFUSED) {
        log_error("reach-finder refuses to search: %s", search->answer.report.why);
        search_end(store, MODEL_STORE_NOT_YET);
    }
}

/* Nobody is there, or a search takes too long. */
static void lose_patience(struct model_store *store, int64_t now)
{
    struct search *search = &store->search;
    int64_t patience = search->absent ? next_patience_us : first_patience_us;

    if (!search->came && now - search->sent_at > patience) {
        if (!search->absent)
            log_warning("no reach-finder is on the bus, so that no body is found; polynomials go "
                        "on");
        search->absent = true;
        search_end(store, MODEL_STORE_NO_FINDER);
    } else if (now - search->sent_at > search_us) {
        log_warning("a search for the body has taken more than %lld s; without it",
                    (long long)(search_us / 1000000));
        search_end(store, MODEL_STORE_NOT_YET);
    }
}

void model_store_follow_search(struct model_store *store, int64_t now)
{
    const struct finder_port *finder = store->settings.finder;
    struct search *search = &store->search;

    if (!model_store_seeks(&store->settings))
        return;
    model_store_tell_if_asked(store);
    say_changed(store);
    if (search_stage_of(store) == SEARCH_FOUND)
        return;
    while (search_stage_of(store) != SEARCH_FOUND && finder->take(finder->user, &search->answer))
        take_answer(store);
    if (search_stage_of(store) != SEARCH_SENT)
        return;
    if (now - search->asked_at > (search->came ? answer_us : again_us)) {
        search->asked_at = now;
        finder->ask_again(finder->user);
    }
    lose_patience(store, now);
}

void model_store_tell_if_asked(struct model_store *store)
{
    const struct finder_port *finder = store->settings.finder;

    if (atomic_exchange_explicit(&store->search.tell, false, memory_order_acquire) &&
        learner_body(store->shadow))
        finder->tell(finder->user, learner_body(store->shadow));
}
