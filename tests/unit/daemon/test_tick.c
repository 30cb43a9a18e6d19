/* The control step under bad weather: requests it must refuse, states that stay away, nonsense. */
#include "fake_robot.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "tick.h"

#include <math.h>
#include <string.h>

static struct config config;
static struct arena *arena;
static struct tick *tick;
static struct fake_robot robot;
static struct tick_inputs inputs;
static struct tick_outputs outputs;
static int64_t seq;

static void begin(void)
{
    config = fixture_config(NULL, 0);
    tick = fixture_tick(&config, &arena);
    ck_assert_uint_eq(arena_used(arena), tick_memory(&config));
    fake_robot_init(&robot, &config);
    memset(&inputs, 0, sizeof inputs);
    inputs.state_age = INFINITY;
}

static void step(bool with_state)
{
    inputs.has_state = with_state;
    if (with_state) {
        inputs.state = fake_robot_state(&robot);
        inputs.state_age = 0;
    }
    tick_decide(tick, &inputs, robot.now, &outputs);
    tick_report(tick, robot.now, &outputs);
    inputs.n_requests = 0;
    if (outputs.has_command)
        fake_robot_step(&robot, &outputs.command);
}

static int ask(reach_request_t request)
{
    request.seq = ++seq;
    inputs.request[inputs.n_requests++] = request;
    step(true);
    return outputs.status.request_result;
}

START_TEST(before_any_state_nothing_is_sent)
{
    begin();
    step(false);
    ck_assert(!outputs.has_command);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_WAITING);
    step(true);
    ck_assert(outputs.has_command);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_IDLE);
    ck_assert_int_eq(outputs.command.state_seq, 1);
    arena_destroy(arena);
}
END_TEST

START_TEST(requests_that_do_not_fit_are_refused)
{
    const reach_request_t babble = {.kind = REACH_REQUEST_T_BABBLE, .count = 3};

    begin();
    step(true);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE}),
                     REACH_STATUS_T_REFUSED_VALUE);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_SAVE}),
                     REACH_STATUS_T_REFUSED_STATE); /* no directory */
    ck_assert_int_eq(ask(babble), REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_ACTIVE);
    ck_assert_int_eq(ask(babble), REACH_STATUS_T_REFUSED_STATE); /* busy */
    ck_assert_int_eq(outputs.status.behaviour, REACH_STATUS_T_BABBLE);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_STOP}), REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(outputs.status.behaviour, REACH_STATUS_T_NONE);
    arena_destroy(arena);
}
END_TEST

START_TEST(a_repeated_request_is_carried_out_once)
{
    begin();
    step(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3});
    ask((reach_request_t){.kind = REACH_REQUEST_T_STOP});
    seq--;
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3}),
                     REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(outputs.status.behaviour, REACH_STATUS_T_NONE);
    arena_destroy(arena);
}
END_TEST

START_TEST(a_stale_state_stops_the_arm_and_a_fresh_one_resumes)
{
    begin();
    step(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3, .seed = 5});
    for (int i = 0; i < 20; i++)
        step(true);
    ck_assert_double_ne(outputs.command.velocity[0], 0);
    for (inputs.state_age = 0.05; inputs.state_age < 0.1; inputs.state_age += config.period) {
        step(false);
        ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_HOLD);
    }
    for (int i = 0; i < 6; i++, inputs.state_age += config.period) {
        step(false);
        ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_SUSPENDED);
    }
    for (int i = 0; i < 6; i++)
        ck_assert_double_eq(outputs.command.velocity[i], 0);
    step(true);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_ACTIVE);
    ck_assert_int_eq(outputs.status.behaviour, REACH_STATUS_T_BABBLE);
    arena_destroy(arena);
}
END_TEST

START_TEST(a_fault_needs_a_reset)
{
    begin();
    step(true);
    inputs.overrunning = true;
    step(true);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_FAULT);
    inputs.overrunning = false;
    step(true);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_FAULT);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3}),
                     REACH_STATUS_T_REFUSED_STATE);
    ask((reach_request_t){.kind = REACH_REQUEST_T_RESET_FAULT});
    step(true);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_IDLE);
    arena_destroy(arena);
}
END_TEST

static int fast; /* a joint that is at speed */

static void babble_at_speed(void)
{
    begin();
    step(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3, .seed = 5});
    for (int i = 0; i < 200; i++) {
        step(true);
        for (fast = 0; fast < 4; fast++)
            if (fabs(outputs.command.velocity[fast]) > 0.5)
                return;
    }
    ck_abort_msg("no joint is fast");
}

/* Rest in as few ticks as the gate's acceleration allows, from the very tick on. */
static void assert_brakes_at_once(void)
{
    double before = outputs.command.velocity[fast];
    double decrease = config.safety_arm_acceleration * config.period;

    step(true);
    while (before != 0) {
        ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_FAULT);
        ck_assert_double_eq_tol(fabs(outputs.command.velocity[fast]),
                                fmax(fabs(before) - decrease, 0), 1e-9);
        before = outputs.command.velocity[fast];
        step(true);
    }
    ck_assert_int_eq(outputs.status.behaviour, REACH_STATUS_T_NONE);
}

START_TEST(an_emergency_stops_the_arm_within_the_tick)
{
    for (int by_message = 0; by_message < 2; by_message++) {
        babble_at_speed();
        if (by_message)
            inputs.request[inputs.n_requests++] =
                (reach_request_t){.kind = REACH_REQUEST_T_EMERGENCY, .seq = ++seq};
        else
            inputs.emergency = true;
        assert_brakes_at_once();
        inputs.emergency = false;
        step(true);
        ck_assert_int_eq(outputs.status.fault, REACH_STATUS_T_FAULT_EMERGENCY);
        ask((reach_request_t){.kind = REACH_REQUEST_T_RESET_FAULT});
        step(true);
        ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_IDLE);
        ck_assert_int_eq(outputs.status.fault, REACH_STATUS_T_FAULT_NONE);
        arena_destroy(arena);
    }
}
END_TEST

/* The loop stood still, the watchdog sent two braking commands: the loop goes on from those. */
START_TEST(the_loop_goes_on_where_the_watchdog_came_to)
{
    double decrease, before;

    babble_at_speed();
    decrease = config.safety_arm_acceleration * config.period;
    before = fabs(outputs.command.velocity[fast]);
    inputs.braked = 2;
    step(true);
    inputs.braked = 0;
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_FAULT);
    ck_assert_int_eq(outputs.status.fault, REACH_STATUS_T_FAULT_STALL);
    ck_assert_double_eq_tol(fabs(outputs.command.velocity[fast]), fmax(before - 3 * decrease, 0),
                            1e-9);
    arena_destroy(arena);
}
END_TEST

/* The robot has stopped by itself while nobody commanded it: it is started like one at rest. */
START_TEST(after_a_long_silence_the_arm_starts_from_rest)
{
    babble_at_speed();
    inputs.robot_rests = true;
    step(true);
    ck_assert_double_le(fabs(outputs.command.velocity[fast]),
                        config.safety_arm_acceleration * config.period + 1e-12);
    arena_destroy(arena);
}
END_TEST

static double fastest(int ticks)
{
    double most = 0;

    for (int i = 0; i < ticks; i++) {
        step(true);
        for (int j = 0; j < config_arm_joints(&config); j++)
            most = fmax(most, fabs(outputs.command.velocity[j]));
    }
    return most;
}

START_TEST(a_new_configuration_holds_from_its_tick_on)
{
    static struct config slower;

    begin();
    step(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 100});
    ck_assert_double_eq_tol(fastest(500), config.arm_velocity, 1e-9);
    slower = config;
    slower.arm_velocity = 0.1 * config.arm_velocity;
    inputs.config = &slower;
    step(true);
    inputs.config = NULL;
    fastest(20); /* slows down */
    ck_assert_double_eq_tol(fastest(500), slower.arm_velocity, 1e-9);
    arena_destroy(arena);
}
END_TEST

START_TEST(a_state_that_is_not_a_number_is_dropped)
{
    begin();
    step(true);
    inputs.state = fake_robot_state(&robot);
    inputs.state.position[2] = NAN;
    tick_decide(tick, &inputs, robot.now, &outputs);
    tick_report(tick, robot.now, &outputs);
    ck_assert_int_eq(outputs.status.bad_inputs, 1);
    ck_assert_int_eq(outputs.status.state_seq, 1); /* the last good one is kept */
    ck_assert_int_eq(outputs.trace.state_seq, 0);
    arena_destroy(arena);
}
END_TEST

/* Bad states do not keep the last good one fresh, however often they come. */
START_TEST(a_state_grows_stale_under_bad_ones)
{
    begin();
    step(true);
    for (int i = 0; i < 10; i++) {
        inputs.has_state = true;
        inputs.state = fake_robot_state(&robot);
        inputs.state.position[1] = NAN;
        inputs.state_age = 0.001;
        tick_decide(tick, &inputs, robot.now, &outputs);
        tick_report(tick, robot.now, &outputs);
    }
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_SUSPENDED);
    ck_assert_double_ge(outputs.status.staleness, 0.19);
    step(true);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_IDLE);
    arena_destroy(arena);
}
END_TEST

/* What was overtaken on its way says where the robot was; a robot begun anew is believed. */
START_TEST(a_state_that_was_overtaken_is_not_taken)
{
    reach_robot_state_t first, second;

    begin();
    step(true);
    first = fake_robot_state(&robot);
    robot.now += 20000;
    second = fake_robot_state(&robot);
    inputs.has_state = true;
    inputs.state_age = 0;
    inputs.state = second;
    tick_decide(tick, &inputs, robot.now, &outputs);
    inputs.state = first;
    tick_decide(tick, &inputs, robot.now, &outputs);
    tick_report(tick, robot.now, &outputs);
    ck_assert_int_eq(outputs.status.state_seq, second.seq);
    ck_assert_int_eq(outputs.trace.state_seq, 0);
    inputs.state.seq = 1;
    inputs.state.utime = 1000000;
    tick_decide(tick, &inputs, robot.now, &outputs);
    tick_report(tick, robot.now, &outputs);
    ck_assert_int_eq(outputs.trace.state_seq, 1);
    arena_destroy(arena);
}
END_TEST

/* Random bytes as messages, for a robot that obeys: limits hold, every command is finite. */
START_TEST(nonsense_moves_nothing_beyond_its_limits)
{
    struct random_state random = fixture_random("test_tick");

    begin();
    step(true);
    for (int round = 0; round < 50000; round++) {
        unsigned char *bytes = (unsigned char *)&inputs;
        bool sane = random_bits(&random) % 4 != 0;
        inputs.n_observations = (int)(random_bits(&random) % (TICK_MAX_OBSERVATIONS + 1));
        for (int i = 0; i < 40; i++)
            bytes[offsetof(struct tick_inputs, observation) +
                  random_bits(&random) % sizeof inputs.observation] =
                (unsigned char)random_bits(&random);
        for (int i = 0; i < 40; i++)
            bytes[offsetof(struct tick_inputs, request) +
                  random_bits(&random) % sizeof inputs.request] =
                (unsigned char)random_bits(&random);
        inputs.n_requests = (int)(random_bits(&random) % 3);
        inputs.has_state = true;
        inputs.state_age = 0;
        inputs.state = fake_robot_state(&robot);
        if (!sane)
            inputs.state.position[random_bits(&random) % 6] = NAN;
        tick_decide(tick, &inputs, robot.now, &outputs);
        while (tick_learn(tick))
            ;
        tick_report(tick, robot.now, &outputs);
        for (int i = 0; i < 6; i++) {
            struct joint_limits limits = config_joint_limits(&config, i);
            ck_assert(fabs(outputs.command.velocity[i]) <= limits.safety_velocity);
            ck_assert(robot.q[i] >= limits.min - 1e-9 && robot.q[i] <= limits.max + 1e-9);
        }
        fake_robot_step(&robot, &outputs.command);
    }
    ck_assert_int_gt(outputs.status.bad_inputs, 1000);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        before_any_state_nothing_is_sent,
        requests_that_do_not_fit_are_refused,
        a_repeated_request_is_carried_out_once,
        a_stale_state_stops_the_arm_and_a_fresh_one_resumes,
        a_fault_needs_a_reset,
        an_emergency_stops_the_arm_within_the_tick,
        the_loop_goes_on_where_the_watchdog_came_to,
        after_a_long_silence_the_arm_starts_from_rest,
        a_new_configuration_holds_from_its_tick_on,
        a_state_that_is_not_a_number_is_dropped,
        a_state_grows_stale_under_bad_ones,
        a_state_that_was_overtaken_is_not_taken,
        nonsense_moves_nothing_beyond_its_limits,
    };

    return SUITE_RUN("tick", tests);
}
