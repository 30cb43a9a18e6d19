/* What a request is answered with: by what came before, by the model, and by the time that is
 * handed in. Nothing is kept on disk here: test_desk_disk.c. */
#include "desk_bench.h"
#include "learner/service/clients.h"
#include "tests/unit/suite.h"

#include <math.h>
#include <string.h>

START_TEST(a_prediction_is_the_learners_own)
{
    struct learner_prediction expected;
    reach_learner_request_t request;
    size_t d, D;

    desk_bench_forgetful();
    d = (size_t)on.settings.learner.n_inputs;
    D = (size_t)on.settings.learner.n_outputs;
    desk_bench_learn(60);
    request = desk_bench_request(REQUEST(PREDICT));
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    ck_assert_int_gt(learner_predict(on.bench.learner, request.z, &expected), 0);
    ck_assert_int_eq(on.output.prediction.n_solutions, expected.n_solutions);
    ck_assert_int_eq(on.output.prediction.seq, request.seq);
    ck_assert_int_eq(on.output.prediction.client, CLIENT);
    ck_assert_int_eq(on.output.prediction.samples, 60);
    for (int s = 0; s < expected.n_solutions; s++) {
        const struct learner_solution *solution = &expected.solution[s];
        ck_assert_mem_eq(on.output.prediction.x[s], solution->value, D * sizeof(double));
        ck_assert_mem_eq(on.output.prediction.x_variance[s], solution->variance,
                         D * sizeof(double));
        ck_assert(on.output.prediction.weight[s] == solution->weight);
        for (size_t row = 0; row < D; row++)
            ck_assert_mem_eq(on.output.prediction.jacobian[s][row], solution->jacobian + row * d,
                             d * sizeof(double));
    }
}
END_TEST

START_TEST(an_inverse_is_the_learners_own)
{
    struct learner_inverse expected;
    reach_learner_request_t request;

    desk_bench_forgetful();
    desk_bench_learn(60);
    request = desk_bench_request(REQUEST(PREDICT_INVERSE));
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    ck_assert_int_gt(learner_predict_inverse(on.bench.learner, request.x, &expected), 0);
    ck_assert_int_eq(on.output.prediction.n_solutions, expected.n_solutions);
    for (int s = 0; s < expected.n_solutions; s++)
        for (int i = 0; i < on.settings.learner.n_inputs; i++) {
            ck_assert(on.output.prediction.z[s][i] == expected.solution[s].z[i]);
            ck_assert(on.output.prediction.z_variance[s][i] == expected.solution[s].variance[i]);
        }
}
END_TEST

START_TEST(nothing_is_predicted_before_anything_is_known)
{
    reach_learner_request_t request;

    desk_bench_forgetful();
    request = desk_bench_request(REQUEST(PREDICT));
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    ck_assert_int_eq(on.output.prediction.n_solutions, 0);
}
END_TEST

START_TEST(what_comes_twice_is_learned_once)
{
    reach_learner_request_t request;
    reach_learner_reply_t first;
    uint64_t hash;

    desk_bench_forgetful();
    desk_bench_learn(20);
    request = desk_bench_request(REQUEST(UPDATE));
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    first = on.output.reply;
    ck_assert_int_eq(first.sample, 21);
    hash = store_bench_hash(&on.bench);
    desk_bench_learn(5);
    ck_assert_uint_ne(store_bench_hash(&on.bench), hash);
    hash = store_bench_hash(&on.bench);
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    ck_assert_int_eq(on.output.reply.sample, first.sample);
    ck_assert_int_eq(on.output.reply.learned, first.learned);
    ck_assert_int_eq(on.output.reply.samples, 26);
    ck_assert_int_eq(on.output.reply.repeated, 1);
    ck_assert_uint_eq(store_bench_hash(&on.bench), hash);
    desk_bench_learn(CLIENTS_REMEMBERED);
    hash = store_bench_hash(&on.bench);
    ck_assert_int_eq(desk_bench_status(&request), REPLY(FORGOTTEN));
    ck_assert_uint_eq(store_bench_hash(&on.bench), hash);
}
END_TEST

START_TEST(what_is_late_is_not_done)
{
    static const int8_t kinds[] = {REQUEST(UPDATE), REQUEST(PREDICT), REQUEST(PREDICT_INVERSE),
                                   REQUEST(STATISTICS)};
    reach_learner_request_t request;

    desk_bench_forgetful();
    for (size_t i = 0; i < sizeof kinds; i++) {
        request = desk_bench_request(kinds[i]);
        request.utime = NOW;
        request.deadline = NOW - 1;
        ck_assert_int_eq(desk_bench_status(&request), REPLY(LATE));
    }
    ck_assert_int_eq(on.output.reply.late, sizeof kinds);
    ck_assert_int_eq(on.output.reply.samples, 0);
    request = desk_bench_request(REQUEST(UPDATE));
    request.utime = NOW - 10;
    request.deadline = NOW;
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    /* Done in time: that is told however late somebody asks again. */
    ck_assert_int_eq(desk_take(on.desk, &request, 1000000, NOW, &on.output), DESK_REPLY);
    ck_assert_int_eq(on.output.reply.status, REPLY(DONE));
    ck_assert_int_eq(on.output.reply.sample, 1);
}
END_TEST

/* Whatever either clock says: the sender's own patience counts, from when it arrived. */
START_TEST(no_clock_that_is_set_makes_a_request_late)
{
    const int64_t hour = INT64_C(3600000000);
    reach_learner_request_t request;

    desk_bench_forgetful();
    for (int ahead = -1; ahead <= 1; ahead++) {
        request = desk_bench_request(REQUEST(UPDATE));
        request.utime = NOW + ahead * hour;
        request.deadline = request.utime + 1000;
        ck_assert_int_eq(desk_take(on.desk, &request, 1000, NOW, &on.output), DESK_REPLY);
        ck_assert_int_eq(on.output.reply.status, REPLY(DONE));
        request = desk_bench_request(REQUEST(UPDATE));
        request.utime = NOW + ahead * hour;
        request.deadline = request.utime + 1000;
        ck_assert_int_eq(desk_take(on.desk, &request, 1001, NOW, &on.output), DESK_REPLY);
        ck_assert_int_eq(on.output.reply.status, REPLY(LATE));
    }
    request.utime = INT64_MIN;
    request.deadline = INT64_MAX;
    ck_assert_int_eq(desk_take(on.desk, &request, 1001, NOW, &on.output), DESK_REPLY);
}
END_TEST

START_TEST(two_clients_do_not_meet)
{
    reach_learner_request_t request;

    desk_bench_forgetful();
    request = desk_bench_request(REQUEST(STATISTICS));
    request.client = CLIENT + 1;
    request.seq = 1;
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    for (int64_t seq = 2; seq < 5; seq++)
        for (int64_t client = CLIENT; client <= CLIENT + 1; client++) {
            request = desk_bench_request(REQUEST(UPDATE));
            request.client = client;
            request.seq = seq;
            ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
        }
    ck_assert_int_eq(on.output.reply.samples, 6);
    ck_assert_int_eq(on.output.reply.repeated, 0);
}
END_TEST

/* Each of these changes one thing of a good request. */
static void spoil(reach_learner_request_t *request, int fault)
{
    switch (fault) {
    case 0:
        request->z[0] = NAN;
        break;
    case 1:
        request->x[request->n_outputs - 1] = INFINITY;
        break;
    case 2:
        request->z[request->n_inputs - 1] = -1.1e9;
        break;
    case 3:
        request->seq = 0;
        break;
    case 4:
        request->seq = INT64_MIN;
        break;
    case 5:
        request->n_inputs++;
        break;
    case 6:
        request->n_outputs = -1;
        break;
    case 7:
        request->kind = REQUEST(SAVE) + 1;
        break;
    case 8:
        request->kind = -1;
        break;
    case 9:
        request->kind = REQUEST(SAVE);
        break;
    default:
        request->client = CLIENT + 1;
        break;
    }
}

START_TEST(what_is_wrong_is_refused_and_changes_nothing)
{
    static const int8_t expected[] = {
        REPLY(VALUE),        REPLY(VALUE),        REPLY(VALUE),         REPLY(VALUE),
        REPLY(VALUE),        REPLY(DIMENSIONS),   REPLY(DIMENSIONS),    REPLY(UNKNOWN_KIND),
        REPLY(UNKNOWN_KIND), REPLY(NO_DIRECTORY), REPLY(UNKNOWN_CLIENT)};
    const int n = (int)(sizeof expected / sizeof expected[0]);
    uint64_t hash;

    desk_bench_forgetful();
    desk_bench_learn(10);
    hash = store_bench_hash(&on.bench);
    for (int fault = 0; fault < n; fault++) {
        reach_learner_request_t request = desk_bench_request(REQUEST(UPDATE));
        spoil(&request, fault);
        ck_assert_msg(desk_bench_status(&request) == expected[fault], "fault %d", fault);
        ck_assert_uint_eq(store_bench_hash(&on.bench), hash);
    }
    ck_assert_int_eq(on.output.reply.refused, n);
}
END_TEST

START_TEST(only_what_counts_is_looked_at)
{
    reach_learner_request_t request;

    desk_bench_forgetful();
    desk_bench_learn(10);
    request = desk_bench_request(REQUEST(PREDICT));
    request.x[0] = NAN;
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    request = desk_bench_request(REQUEST(PREDICT_INVERSE));
    request.z[0] = NAN;
    ck_assert_int_eq(desk_bench_take(&request), DESK_PREDICTION);
    request = desk_bench_request(REQUEST(UPDATE));
    request.z[request.n_inputs] = NAN;
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
}
END_TEST

/* A walk whose tracker holds its answer from request `from` on. */
static reach_learner_request_t walk(int step, int from)
{
    reach_learner_request_t request = desk_bench_request(REQUEST(UPDATE));

    request.z[0] = sin(0.05 * step);
    request.z[1] = cos(0.03 * step);
    request.x[0] = 0.1 * sin(0.05 * (step < from ? step : from));
    return request;
}

START_TEST(a_frozen_tracker_is_not_learned)
{
    reach_learner_request_t request;

    for (int learns = 0; learns < 2; learns++) {
        desk_bench_forgetful();
        if (learns)
            desk_learn_frozen(on.desk);
        for (int step = 0; step < 130; step++) {
            request = walk(step, 100);
            ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
            if (!learns)
                ck_assert_int_eq(on.output.reply.learned == REPLY(FROZEN), step > 101);
        }
        /* At step 101 inputs have moved by less than 1 % of their range. */
        ck_assert_int_eq(on.output.reply.frozen, 28);
        ck_assert_int_eq(on.output.reply.troubles & REPLY(STILL), REPLY(STILL));
        ck_assert_int_eq(on.output.reply.samples, learns ? 130 : 102);
    }
}
END_TEST

START_TEST(troubles_are_told)
{
    reach_learner_request_t request;
    char text[200];

    desk_bench_forgetful();
    for (int i = 0; i < 60; i++) {
        request = desk_bench_request(REQUEST(UPDATE));
        request.z[1] = 0.5;
        ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    }
    ck_assert_int_ne(on.output.reply.troubles & REPLY(CONSTANT), 0);
    ck_assert_uint_eq(desk_troubles(on.desk), (unsigned)on.output.reply.troubles);
    desk_tell(on.desk, HEALTH_CONSTANT, text, sizeof text);
    ck_assert_str_eq(text, "input 2 is 0.5 in all 60 samples: what it does is not learned");
}
END_TEST

START_TEST(losses_are_told)
{
    reach_learner_request_t request;

    desk_bench_forgetful();
    desk_note_losses(on.desk, 5, 7);
    request = desk_bench_request(REQUEST(STATISTICS));
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    ck_assert_int_eq(on.output.reply.dropped, 5);
    ck_assert_int_eq(on.output.reply.malformed, 7);
    ck_assert_int_eq(on.output.reply.requests, 2);
}
END_TEST

int main(void)
{
    const TTest *tests[] = {a_prediction_is_the_learners_own,
                            an_inverse_is_the_learners_own,
                            nothing_is_predicted_before_anything_is_known,
                            what_comes_twice_is_learned_once,
                            what_is_late_is_not_done,
                            no_clock_that_is_set_makes_a_request_late,
                            two_clients_do_not_meet,
                            what_is_wrong_is_refused_and_changes_nothing,
                            only_what_counts_is_looked_at,
                            a_frozen_tracker_is_not_learned,
                            troubles_are_told,
                            losses_are_told};

    return SUITE_RUN("desk", tests);
}
