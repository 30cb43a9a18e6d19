/* A body that is found while clients teach: when its search is asked for, what is answered while it
 * is taken, and that the model on disk has it. */
#include "desk_bench.h"
#include "tests/unit/store/body_bench.h"
#include "tests/unit/suite.h"

#include <stdlib.h>

enum { FIRST_SEARCH = 15 }; /* samples that differ */

static uint64_t taught;
static reach_learner_reply_t reply; /* the newest */

static void open_with(const char *directory)
{
    taught = 0;
    desk_bench_open(body_bench_settings(directory));
}

static reach_learner_request_t next_sample(void)
{
    reach_learner_request_t request = desk_bench_request(REQUEST(UPDATE));

    body_bench_sample(taught + 1, request.z, request.x);
    return request;
}

static void teach(int samples)
{
    for (int i = 0; i < samples; i++) {
        const reach_learner_request_t request = next_sample();
        enum desk_answer answer = desk_bench_take(&request);
        reply = on.output.reply;
        if (answer == DESK_SILENT) {
            store_bench_serve(&on.bench);
            ck_assert(desk_due(on.desk, NOW, &reply));
        }
        ck_assert_int_eq(reply.status, REPLY(DONE));
        taught++;
    }
}

static int known(void)
{
    const reach_learner_request_t request = desk_bench_request(REQUEST(STATISTICS));

    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    return on.output.reply.body;
}

/* Until the desk waits for the body that was found. */
static void find_body(void)
{
    teach(FIRST_SEARCH);
    ck_assert_int_eq(known(), REPLY(BODY_SEARCHING));
    for (int looks = 0; body_bench_finder.asked == 0 || !body_bench_finder.answered; looks++) {
        ck_assert_int_lt(looks, 5);
        store_bench_serve(&on.bench);
    }
    ck_assert_int_eq(body_bench_finder.samples, FIRST_SEARCH);
    ck_assert(!desk_due(on.desk, NOW, &reply));
}

START_TEST(nothing_is_learned_while_a_body_is_taken)
{
    char directory[] = "/tmp/reach-desk-XXXXXX";
    const char *directories[] = {"", mkdtemp(directory)};

    for (int kept = 0; kept < 2; kept++) {
        reach_learner_request_t request;
        open_with(directories[kept]);
        find_body();
        request = next_sample();
        ck_assert_int_eq(desk_bench_status(&request), REPLY(BUSY));
        store_bench_serve(&on.bench); /* gives the body */
        ck_assert_int_eq(desk_bench_status(&request), REPLY(BUSY));
        ck_assert_int_eq(known(), REPLY(BODY_SEARCHING));
        ck_assert(!desk_due(on.desk, NOW, &reply)); /* takes it */
        ck_assert_int_eq(known(), REPLY(BODY_FOUND));
        ck_assert_int_eq(on.output.reply.samples, FIRST_SEARCH);
        teach(3);
        ck_assert_int_eq(known(), REPLY(BODY_FOUND));
        ck_assert_int_eq(on.output.reply.samples, FIRST_SEARCH + 3);
    }
    store_bench_remove(directory);
}
END_TEST

START_TEST(predictions_go_on_and_know_it)
{
    reach_learner_request_t request;
    double x[BODY_OUTPUTS];

    open_with("");
    find_body();
    request = next_sample();
    request.kind = REQUEST(PREDICT);
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    store_bench_serve(&on.bench);
    ck_assert(!desk_due(on.desk, NOW, &reply));
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    body_bench_sample(taught + 1, request.z, x);
    for (int row = 0; row < BODY_OUTPUTS; row++)
        ck_assert_double_eq_tol(on.output.prediction.x[0][row], x[row], 2e-3);
}
END_TEST

START_TEST(the_next_start_has_the_body)
{
    char directory[] = "/tmp/reach-desk-XXXXXX";
    const uint64_t given = FIRST_SEARCH;
    struct store_bench next;

    open_with(mkdtemp(directory));
    find_body();
    store_bench_serve(&on.bench);
    desk_due(on.desk, NOW, &reply);
    teach(4);
    ck_assert_int_eq(reply.stored, FIRST_SEARCH + 4);
    model_store_close(on.bench.store);
    next = store_bench_create(&on.settings);
    ck_assert_ptr_nonnull(learner_body(next.learner));
    ck_assert_uint_eq(store_bench_hash(&next), body_bench_hash_at(&on.settings, taught, &given, 1));
    store_bench_remove(directory);
}
END_TEST

START_TEST(that_nobody_searches_is_told)
{
    open_with("");
    body_bench_finder.absent = true;
    teach(FIRST_SEARCH);
    for (int looks = 0; looks < 6; looks++) /* a second each */
        store_bench_serve(&on.bench);
    ck_assert_int_eq(known(), REPLY(BODY_NO_FINDER));
    teach(1);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {nothing_is_learned_while_a_body_is_taken, predictions_go_on_and_know_it,
                            the_next_start_has_the_body, that_nobody_searches_is_told};

    return SUITE_RUN("desk with a body", tests);
}
