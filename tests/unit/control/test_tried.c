/* Babbling finds by itself where the marker can be fixated. */
#include "daemon/control/behaviours/tried.h"
#include "daemon/control/tick.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "tools/bench/fake_robot.h"

#include <string.h>

static const char *const whole_range[] = {"babble.min=[]", "babble.max=[]", "fixation.timeout=2"};

START_TEST(the_nearest_decides)
{
    struct config config = fixture_config(NULL, 0);
    static struct tried tried;
    double good[MAX_JOINTS] = {-1.2, -0.3, 0, -1.2}, bad[MAX_JOINTS] = {-1.1, -0.3, 0, -0.8};
    double between[MAX_JOINTS] = {-1.1, -0.3, 0, -0.9};

    ck_assert(tried_promises(&tried, &config, bad));
    tried_note(&tried, good, true);
    tried_note(&tried, bad, false);
    ck_assert(tried_promises(&tried, &config, good));
    ck_assert(!tried_promises(&tried, &config, between));
    /* What is old is forgotten. */
    for (int i = 0; i < TRIED_LENGTH; i++)
        tried_note(&tried, good, true);
    ck_assert(tried_promises(&tried, &config, bad));
}
END_TEST

/* Postures given up while `count` samples are babbled over the whole range. */
static int given_up(struct tick *tick, struct fake_robot *robot, int count)
{
    static struct tick_outputs outputs;
    static int64_t seq;
    struct tick_inputs inputs = {.has_state = true, .n_requests = 1};

    inputs.request[0] = (reach_request_t){
        .kind = REACH_REQUEST_T_BABBLE, .count = count, .seed = 4 + seq, .seq = seq + 1};
    seq++;
    for (int i = 0; i < 200000; i++) {
        inputs.state = fake_robot_state(robot);
        inputs.n_observations = robot->has_marker;
        inputs.observation[0] = robot->marker;
        tick_decide(tick, &inputs, robot->now, &outputs);
        tick_report(tick, robot->now, &outputs);
        fake_robot_step(robot, &outputs.command);
        if (outputs.status.request_seq == seq && outputs.status.behaviour == REACH_STATUS_T_NONE &&
            outputs.status.progress == count)
            break;
        if (outputs.status.request_seq == seq &&
            outputs.status.request_result == REACH_STATUS_T_ACCEPTED)
            inputs.n_requests = 0;
        else
            inputs.request[0].seq = ++seq; /* refused before a state was known */
    }
    ck_assert_int_eq(outputs.status.progress, count);
    return outputs.status.skipped;
}

START_TEST(it_learns_where_to_babble)
{
    struct config config = fixture_config(whole_range, 3);
    struct arena *arena;
    struct tick *tick = fixture_tick(&config, &arena);
    struct fake_robot robot;
    int first, later;

    ck_assert_double_eq_tol(config.babble_max.value[3],
                            config.arm_max.value[3] - config.motion_margin, 1e-12);
    fake_robot_init(&robot, &config);
    robot.q[0] = -1.1;
    robot.q[3] = -1.1;
    first = given_up(tick, &robot, 40);
    given_up(tick, &robot, 60);
    later = given_up(tick, &robot, 40);
    printf("%d given up of 40 at first, %d later\n", first, later);
    ck_assert_int_ge(first, 3);
    ck_assert_int_le(2 * later, first);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {the_nearest_decides, it_learns_where_to_babble};

    return SUITE_RUN("tried", tests);
}
