/* Saving and loading as they are asked for: one after the other, none under a behaviour, and each
 * with a result of its own. */
#include "daemon/control/tick_private.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <reach_status_t.h>

/* A keeper of the model that begins whatever it is asked to, and has done with it when told. */
static struct {
    int begun; /* number of the newest save or load */
    enum model_result result;
} keeper;

static bool begin_any(void *context, int number)
{
    (void)context;
    keeper.begun = number;
    return true;
}

static enum model_result poll(void *context, struct learner **learner)
{
    enum model_result result = keeper.result;

    (void)context, (void)learner;
    keeper.result = MODEL_NOTHING;
    return result;
}

static void begin(void)
{
    static struct model_port_ops ops;
    struct model_port port = model_port_none();

    world_begin(fixture_config(NULL, 0), 0);
    ops = *port.ops;
    ops.begin_save = ops.begin_load = begin_any;
    ops.poll = poll;
    world.tick->model.ops = &ops;
    keeper.begun = 0;
    world_step();
}

static int ask(int8_t kind, int number)
{
    return world_ask((reach_request_t){.kind = kind, .count = number, .seed = 1});
}

/* What the status says of the newest save or load. */
static void assert_model(int64_t seq, int result)
{
    ck_assert_int_eq(world.outputs.status.model_request_seq, seq);
    ck_assert_int_eq(world.outputs.status.model_result, result);
}

START_TEST(no_behaviour_begins_before_the_model_is_exchanged)
{
    begin();
    ck_assert_int_eq(ask(REACH_REQUEST_T_LOAD, 1), REACH_STATUS_T_PENDING);
    ck_assert_int_eq(ask(REACH_REQUEST_T_BABBLE, 3), REACH_STATUS_T_REFUSED_STATE);
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_NONE);
    keeper.result = MODEL_DONE;
    world_step();
    ck_assert_int_eq(ask(REACH_REQUEST_T_BABBLE, 3), REACH_STATUS_T_ACCEPTED);
    world_end();
}
END_TEST

START_TEST(a_behaviour_may_begin_while_the_model_is_saved)
{
    begin();
    ck_assert_int_eq(ask(REACH_REQUEST_T_SAVE, 1), REACH_STATUS_T_PENDING);
    ck_assert_int_eq(ask(REACH_REQUEST_T_BABBLE, 3), REACH_STATUS_T_ACCEPTED);
    world_end();
}
END_TEST

START_TEST(a_load_has_its_own_result_whatever_is_asked_after_it)
{
    int64_t load;

    begin();
    assert_model(0, 0);
    ck_assert_int_eq(ask(REACH_REQUEST_T_LOAD, 1), REACH_STATUS_T_PENDING);
    load = world.request_seq;
    ck_assert_int_eq(ask(REACH_REQUEST_T_STOP, 0), REACH_STATUS_T_ACCEPTED);
    assert_model(load, REACH_STATUS_T_PENDING);
    ck_assert_int_eq(ask(REACH_REQUEST_T_LOAD, 2), REACH_STATUS_T_REFUSED_STATE);
    ck_assert_int_eq(ask(REACH_REQUEST_T_SAVE, 3), REACH_STATUS_T_REFUSED_STATE);
    ck_assert_int_eq(keeper.begun, 1);
    assert_model(load, REACH_STATUS_T_PENDING);
    keeper.result = MODEL_FAILED;
    world_step();
    assert_model(load, REACH_STATUS_T_FAILED);
    ck_assert_int_eq(world.outputs.status.request_result, REACH_STATUS_T_REFUSED_STATE);
    /* Sent again late, it is not carried out again. */
    world.inputs.request[0] = (reach_request_t){.kind = REACH_REQUEST_T_LOAD, .seq = load};
    world.inputs.n_requests = 1;
    world_step();
    assert_model(load, REACH_STATUS_T_FAILED);
    world_end();
}
END_TEST

/* Contexts are of the experts, which are others then. */
START_TEST(a_second_load_in_between_leaves_no_context_of_the_first_model)
{
    begin();
    world.tick->context.count = 3;
    ck_assert_int_eq(ask(REACH_REQUEST_T_LOAD, 1), REACH_STATUS_T_PENDING);
    ck_assert_int_eq(ask(REACH_REQUEST_T_LOAD, 2), REACH_STATUS_T_REFUSED_STATE);
    ck_assert_int_eq(world.outputs.status.contexts, 3);
    keeper.result = MODEL_DONE;
    world_step();
    ck_assert_int_eq(world.outputs.status.contexts, 0);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        no_behaviour_begins_before_the_model_is_exchanged,
        a_behaviour_may_begin_while_the_model_is_saved,
        a_load_has_its_own_result_whatever_is_asked_after_it,
        a_second_load_in_between_leaves_no_context_of_the_first_model,
    };

    return SUITE_RUN("model_requests", tests);
}
