/* When a sample is answered that goes to disk: when it is safe there, or when the disk refuses it.
 */
#include "desk_bench.h"
#include "learner/store/model_file.h"
#include "tests/unit/store/fake_disk.h"
#include "tests/unit/suite.h"

#include <errno.h>

START_TEST(a_sample_is_answered_when_it_is_safe)
{
    reach_learner_request_t update[3], prediction;
    reach_learner_reply_t reply;

    desk_bench_keeping();
    for (int i = 0; i < 3; i++) {
        update[i] = desk_bench_request(REQUEST(UPDATE));
        ck_assert_int_eq(desk_bench_take(&update[i]), DESK_SILENT);
    }
    ck_assert_int_eq(desk_bench_take(&update[1]), DESK_SILENT); /* again, and still not safe */
    ck_assert(!desk_due(on.desk, NOW, &reply));
    prediction = desk_bench_request(REQUEST(PREDICT));
    ck_assert_int_eq(desk_bench_take(&prediction), DESK_PREDICTION);
    ck_assert_int_eq(on.output.prediction.samples, 3);
    store_bench_serve(&on.bench);
    for (int i = 0; i < 3; i++) {
        ck_assert(desk_due(on.desk, NOW, &reply));
        ck_assert_int_eq(reply.seq, update[i].seq);
        ck_assert_int_eq(reply.status, REPLY(DONE));
        ck_assert_int_eq(reply.sample, i + 1);
        ck_assert_int_ge(reply.stored, reply.sample);
    }
    ck_assert(!desk_due(on.desk, NOW, &reply));
    ck_assert_int_eq(desk_bench_status(&update[1]), REPLY(DONE));
    ck_assert_int_eq(on.output.reply.samples, 3);
}
END_TEST

START_TEST(what_was_answered_outlives_a_kill)
{
    struct store_bench next;
    reach_learner_reply_t reply;
    int64_t safe = 0;

    desk_bench_keeping();
    for (int i = 0; i < 50; i++) {
        const reach_learner_request_t request = desk_bench_request(REQUEST(UPDATE));
        desk_bench_take(&request);
        if (i % 7 == 0)
            store_bench_serve(&on.bench);
        while (desk_due(on.desk, NOW, &reply))
            safe = reply.sample;
    }
    fake_disk_crash(FAKE_DISK_POWER_OFF);
    next = store_bench_create(&on.settings);
    ck_assert_int_gt(safe, 40);
    ck_assert_int_ge((int64_t)model_samples(next.learner), safe);
}
END_TEST

START_TEST(a_disk_that_refuses_is_told)
{
    reach_learner_request_t request;
    reach_learner_reply_t reply;

    desk_bench_keeping();
    fake_disk.read_only = true;
    fake_disk.error = EROFS;
    request = desk_bench_request(REQUEST(UPDATE));
    ck_assert_int_eq(desk_bench_take(&request), DESK_SILENT);
    store_bench_serve(&on.bench);
    ck_assert(desk_due(on.desk, NOW, &reply));
    ck_assert_int_eq(reply.status, REPLY(NOT_STORED));
    ck_assert_int_eq(reply.storing, 0);
    ck_assert_int_eq(reply.samples, 1); /* learned all the same */
    ck_assert_int_eq(desk_bench_status(&request), REPLY(NOT_STORED));
    fake_disk.read_only = false;
    for (int i = 0; i < 3; i++) /* a second each */
        store_bench_serve(&on.bench);
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    ck_assert_int_eq(on.output.reply.samples, 1);
}
END_TEST

START_TEST(what_has_no_room_is_asked_for_again)
{
    reach_learner_request_t request;
    reach_learner_reply_t reply;
    int answered = 0;

    desk_bench_keeping();
    for (int i = 0; i < DESK_WAITING; i++) {
        request = desk_bench_request(REQUEST(UPDATE));
        ck_assert_int_eq(desk_bench_take(&request), DESK_SILENT);
    }
    request = desk_bench_request(REQUEST(UPDATE));
    ck_assert_int_eq(desk_bench_status(&request), REPLY(BUSY));
    ck_assert_int_eq(on.output.reply.samples, DESK_WAITING);
    store_bench_serve(&on.bench);
    while (desk_due(on.desk, NOW, &reply))
        answered++;
    ck_assert_int_eq(answered, DESK_WAITING);
    ck_assert_int_eq(desk_bench_take(&request), DESK_SILENT); /* it was not done before */
}
END_TEST

START_TEST(a_save_is_answered_when_it_is_there)
{
    reach_learner_request_t request, second;
    reach_learner_reply_t reply;

    desk_bench_keeping();
    request = desk_bench_request(REQUEST(SAVE));
    request.number = 12;
    ck_assert_int_eq(desk_bench_take(&request), DESK_SILENT);
    second = desk_bench_request(REQUEST(SAVE));
    ck_assert_int_eq(desk_bench_status(&second), REPLY(BUSY));
    ck_assert(!desk_due(on.desk, NOW, &reply));
    store_bench_serve(&on.bench);
    ck_assert(desk_due(on.desk, NOW, &reply));
    ck_assert_int_eq(reply.seq, request.seq);
    ck_assert_int_eq(reply.status, REPLY(DONE));
    ck_assert(files_exists(&fake_disk_files, FAKE_DISK_DIRECTORY "/model-12.imle"));
    ck_assert_int_eq(desk_bench_status(&request), REPLY(DONE));
    request = desk_bench_request(REQUEST(SAVE));
    request.number = 1000000;
    ck_assert_int_eq(desk_bench_status(&request), REPLY(VALUE));
    fake_disk.read_only = true;
    fake_disk.error = EROFS;
    ck_assert_int_eq(desk_bench_take(&second), DESK_SILENT);
    store_bench_serve(&on.bench);
    ck_assert(desk_due(on.desk, NOW, &reply));
    ck_assert_int_eq(reply.status, REPLY(FAILED));
    ck_assert_int_eq(desk_bench_status(&second), REPLY(FAILED));
}
END_TEST

int main(void)
{
    const TTest *tests[] = {a_sample_is_answered_when_it_is_safe, what_was_answered_outlives_a_kill,
                            a_disk_that_refuses_is_told, what_has_no_room_is_asked_for_again,
                            a_save_is_answered_when_it_is_there};

    return SUITE_RUN("desk on a disk", tests);
}
