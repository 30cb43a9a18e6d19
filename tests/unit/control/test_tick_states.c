/* The control step when states stay away, are overtaken or nonsense. */
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

static void begin(void)
{
    world_begin(fixture_config(NULL, 0), 0);
}

START_TEST(a_stale_state_stops_the_arm_and_a_fresh_one_resumes)
{
    begin();
    world_tick(true);
    world_prepare((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3, .seed = 5});
    for (int i = 0; i < 21; i++)
        world_tick(true);
    ck_assert_double_ne(world.outputs.command.velocity[0], 0);
    for (world.inputs.state_age = 0.05; world.inputs.state_age < 0.1;
         world.inputs.state_age += world.config.period) {
        world_tick(false);
        ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_HOLD);
    }
    for (int i = 0; i < 6; i++, world.inputs.state_age += world.config.period) {
        world_tick(false);
        ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_SUSPENDED);
    }
    for (int i = 0; i < 6; i++)
        ck_assert_double_eq(world.outputs.command.velocity[i], 0);
    world_tick(true);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_ACTIVE);
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_BABBLE);
    world_end();
}
END_TEST

START_TEST(a_state_that_is_not_a_number_is_dropped)
{
    begin();
    world_tick(true);
    world.inputs.state = fake_robot_state(&world.robot);
    world.inputs.state.position[2] = NAN;
    world_decide();
    ck_assert_int_eq(world.outputs.status.bad_inputs, 1);
    ck_assert_int_eq(world.outputs.status.state_seq, 1); /* the last good one is kept */
    ck_assert_int_eq(world.outputs.trace.state_seq, 0);
    world_end();
}
END_TEST

/* Bad states do not keep the last good one fresh, however often they come. */
START_TEST(a_state_grows_stale_under_bad_ones)
{
    begin();
    world_tick(true);
    for (int i = 0; i < 10; i++) {
        world.inputs.has_state = true;
        world.inputs.state = fake_robot_state(&world.robot);
        world.inputs.state.position[1] = NAN;
        world.inputs.state_age = 0.001;
        world_decide();
    }
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_SUSPENDED);
    ck_assert_double_ge(world.outputs.status.staleness, 0.19);
    world_tick(true);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_IDLE);
    world_end();
}
END_TEST

/* What was overtaken on its way says where the robot was; a robot begun anew is believed. */
START_TEST(a_state_that_was_overtaken_is_not_taken)
{
    reach_robot_state_t first, second;

    begin();
    world_tick(true);
    first = fake_robot_state(&world.robot);
    world.robot.now += 20000;
    second = fake_robot_state(&world.robot);
    world.inputs.has_state = true;
    world.inputs.state_age = 0;
    world.inputs.state = second;
    world_decide();
    world.inputs.state = first;
    world_decide();
    ck_assert_int_eq(world.outputs.status.state_seq, second.seq);
    ck_assert_int_eq(world.outputs.trace.state_seq, 0);
    world.inputs.state.seq = 1;
    world.inputs.state.utime = 1000000;
    world_decide();
    ck_assert_int_eq(world.outputs.trace.state_seq, 1);
    world_end();
}
END_TEST

/* Random bytes as messages, for a robot that obeys: limits hold, every command is finite. */
START_TEST(nonsense_moves_nothing_beyond_its_limits)
{
    struct random_state random = fixture_random("test_tick");

    begin();
    world_tick(true);
    for (int round = 0; round < 50000; round++) {
        unsigned char *bytes = (unsigned char *)&world.inputs;
        bool sane = random_bits(&random) % 4 != 0;
        world.inputs.n_observations = (int)(random_bits(&random) % (TICK_MAX_OBSERVATIONS + 1));
        for (int i = 0; i < 40; i++)
            bytes[offsetof(struct tick_inputs, observation) +
                  random_bits(&random) % sizeof world.inputs.observation] =
                (unsigned char)random_bits(&random);
        for (int i = 0; i < 40; i++)
            bytes[offsetof(struct tick_inputs, request) +
                  random_bits(&random) % sizeof world.inputs.request] =
                (unsigned char)random_bits(&random);
        world.inputs.n_requests = (int)(random_bits(&random) % 3);
        world.inputs.has_state = true;
        world.inputs.state_age = 0;
        world.inputs.state = fake_robot_state(&world.robot);
        if (!sane)
            world.inputs.state.position[random_bits(&random) % 6] = NAN;
        tick_decide(world.tick, &world.inputs, world.robot.now, &world.outputs);
        while (tick_learn(world.tick))
            ;
        tick_report(world.tick, world.robot.now, &world.outputs);
        for (int i = 0; i < 6; i++) {
            struct joint_limits limits = config_joint_limits(&world.config, i);
            ck_assert(fabs(world.outputs.command.velocity[i]) <= limits.safety_velocity);
            ck_assert(world.robot.q[i] >= limits.min - 1e-9 &&
                      world.robot.q[i] <= limits.max + 1e-9);
        }
        fake_robot_step(&world.robot, &world.outputs.command);
    }
    ck_assert_int_gt(world.outputs.status.bad_inputs, 1000);
    world_end();
}
END_TEST

/* Counted where it belongs, with what was wrong. */
START_TEST(a_refusal_names_joint_value_and_range)
{
    const reach_status_t *status = &world.outputs.status;
    struct joint_limits limits;

    begin();
    world_tick(true);
    limits = config_joint_limits(&world.config, 2);
    world.inputs.has_state = true;
    world.inputs.state = fake_robot_state(&world.robot);
    world.inputs.state.position[2] = 2.5;
    world_decide();
    ck_assert_int_eq(status->refused[REACH_STATUS_T_CHANNEL_STATE][REACH_STATUS_T_VALUE], 1);
    ck_assert_int_eq(status->bad_inputs, 1);
    ck_assert_int_eq(status->refused_state, world.inputs.state.seq);
    ck_assert_int_eq(status->refused_joint, 3);
    ck_assert_double_eq(status->refused_value, 2.5);
    ck_assert_double_eq_tol(status->refused_min, limits.min - 0.35, 1e-12);
    ck_assert_double_eq_tol(status->refused_max, limits.max + 0.35, 1e-12);
    world.inputs.state.n_joints = 5;
    world_decide();
    ck_assert_int_eq(status->refused_joint, 0);
    world_end();
}
END_TEST

/* The sender waits: it gets an answer at once, and the arm holds. */
START_TEST(in_lockstep_a_refused_state_is_answered)
{
    begin();
    for (int known = 0; known < 2; known++) {
        world.inputs.has_state = true;
        world.inputs.state = fake_robot_state(&world.robot);
        world.inputs.state.lockstep = 1;
        world.inputs.state.position[0] = NAN;
        world_decide();
        ck_assert(world.outputs.has_command);
        ck_assert_int_eq(world.outputs.command.state_seq, world.inputs.state.seq);
        for (int i = 0; i < 6; i++)
            ck_assert_double_eq(world.outputs.command.velocity[i], 0);
        world_tick(true);
        ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_IDLE);
    }
    world_prepare((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3, .seed = 5});
    for (int i = 0; i < 21; i++)
        world_tick(true);
    world.inputs.has_state = true;
    world.inputs.state = fake_robot_state(&world.robot);
    world.inputs.state.lockstep = 1;
    world.inputs.state.n_joints = 1;
    world_decide();
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_HOLD);
    world_end();
}
END_TEST

START_TEST(what_is_of_another_time_is_counted)
{
    const reach_status_t *status = &world.outputs.status;

    begin();
    world.robot.now += 100 * (int64_t)1000000;
    world_tick(true);
    world_tick(true);
    world.inputs.n_observations = 1;
    for (int i = 0; i < 2; i++) {
        world.inputs.observation[0] = (struct observation){
            .utime = world.robot.now + (i ? 10 : -10) * (int64_t)1000000, .seq = 1, .seen = 1};
        world_tick(true);
    }
    ck_assert_int_eq(status->refused[REACH_STATUS_T_CHANNEL_SENSE][REACH_STATUS_T_TIME], 2);
    world.inputs.n_observations = 0;
    world_decide(); /* the same state once more */
    ck_assert_int_eq(status->refused[REACH_STATUS_T_CHANNEL_STATE][REACH_STATUS_T_TIME], 1);
    ck_assert_int_eq(status->bad_inputs, 3);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_stale_state_stops_the_arm_and_a_fresh_one_resumes,
        a_state_that_is_not_a_number_is_dropped,
        a_state_grows_stale_under_bad_ones,
        a_state_that_was_overtaken_is_not_taken,
        nonsense_moves_nothing_beyond_its_limits,
        a_refusal_names_joint_value_and_range,
        in_lockstep_a_refused_state_is_answered,
        what_is_of_another_time_is_counted,
    };

    return SUITE_RUN("tick_states", tests);
}
