/* The control step: requests that it must refuse, stops, faults, a new configuration. */
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

static void begin(void)
{
    world_begin(fixture_config(NULL, 0), 0);
    ck_assert_uint_eq(arena_used(world.arena), tick_memory(&world.config));
}

static int ask(reach_request_t request)
{
    world_prepare(request);
    world_tick(true);
    return world.outputs.status.request_result;
}

START_TEST(before_any_state_nothing_is_sent)
{
    begin();
    world_tick(false);
    ck_assert(!world.outputs.has_command);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_WAITING);
    world_tick(true);
    ck_assert(world.outputs.has_command);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_IDLE);
    ck_assert_int_eq(world.outputs.command.state_seq, 1);
    world_end();
}
END_TEST

START_TEST(requests_that_do_not_fit_are_refused)
{
    const reach_request_t babble = {.kind = REACH_REQUEST_T_BABBLE, .count = 3};

    begin();
    world_tick(true);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE}),
                     REACH_STATUS_T_REFUSED_VALUE);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_SAVE}),
                     REACH_STATUS_T_REFUSED_STATE); /* no directory */
    ck_assert_int_eq(ask(babble), REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_ACTIVE);
    ck_assert_int_eq(ask(babble), REACH_STATUS_T_REFUSED_STATE); /* busy */
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_BABBLE);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_STOP}), REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_NONE);
    world_end();
}
END_TEST

START_TEST(a_repeated_request_is_carried_out_once)
{
    begin();
    world_tick(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3});
    ask((reach_request_t){.kind = REACH_REQUEST_T_STOP});
    world.request_seq--;
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3}),
                     REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_NONE);
    world_end();
}
END_TEST

START_TEST(a_fault_needs_a_reset)
{
    begin();
    world_tick(true);
    world.inputs.overrunning = true;
    world_tick(true);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_FAULT);
    world.inputs.overrunning = false;
    world_tick(true);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_FAULT);
    ck_assert_int_eq(ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3}),
                     REACH_STATUS_T_REFUSED_STATE);
    ask((reach_request_t){.kind = REACH_REQUEST_T_RESET_FAULT});
    world_tick(true);
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_IDLE);
    world_end();
}
END_TEST

static int fast; /* a joint that is at speed */

static void babble_at_speed(void)
{
    begin();
    world_tick(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 3, .seed = 5});
    for (int i = 0; i < 200; i++) {
        world_tick(true);
        for (fast = 0; fast < 4; fast++)
            if (fabs(world.outputs.command.velocity[fast]) > 0.5)
                return;
    }
    ck_abort_msg("no joint is fast");
}

/* Rest in as few ticks as the gate's acceleration allows, from the very tick on. */
static void assert_brakes_at_once(void)
{
    double before = world.outputs.command.velocity[fast];
    double decrease = world.config.safety_arm_acceleration * world.config.period;

    world_tick(true);
    while (before != 0) {
        ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_FAULT);
        ck_assert_double_eq_tol(fabs(world.outputs.command.velocity[fast]),
                                fmax(fabs(before) - decrease, 0), 1e-9);
        before = world.outputs.command.velocity[fast];
        world_tick(true);
    }
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_NONE);
}

START_TEST(an_emergency_stops_the_arm_within_the_tick)
{
    for (int by_message = 0; by_message < 2; by_message++) {
        babble_at_speed();
        if (by_message)
            world_prepare((reach_request_t){.kind = REACH_REQUEST_T_EMERGENCY});
        else
            world.inputs.emergency = true;
        assert_brakes_at_once();
        world.inputs.emergency = false;
        world_tick(true);
        ck_assert_int_eq(world.outputs.status.fault, REACH_STATUS_T_FAULT_EMERGENCY);
        ask((reach_request_t){.kind = REACH_REQUEST_T_RESET_FAULT});
        world_tick(true);
        ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_IDLE);
        ck_assert_int_eq(world.outputs.status.fault, REACH_STATUS_T_FAULT_NONE);
        world_end();
    }
}
END_TEST

/* The loop stood still, the watchdog sent two braking commands: the loop goes on from those. */
START_TEST(the_loop_goes_on_where_the_watchdog_came_to)
{
    double decrease, before;

    babble_at_speed();
    decrease = world.config.safety_arm_acceleration * world.config.period;
    before = fabs(world.outputs.command.velocity[fast]);
    world.inputs.braked = 2;
    world_tick(true);
    world.inputs.braked = 0;
    ck_assert_int_eq(world.outputs.status.state, REACH_STATUS_T_FAULT);
    ck_assert_int_eq(world.outputs.status.fault, REACH_STATUS_T_FAULT_STALL);
    ck_assert_double_eq_tol(fabs(world.outputs.command.velocity[fast]),
                            fmax(before - 3 * decrease, 0), 1e-9);
    world_end();
}
END_TEST

/* The robot has stopped by itself while nobody commanded it: it is started like one at rest. */
START_TEST(after_a_long_silence_the_arm_starts_from_rest)
{
    babble_at_speed();
    world.inputs.robot_rests = true;
    world_tick(true);
    ck_assert_double_le(fabs(world.outputs.command.velocity[fast]),
                        world.config.safety_arm_acceleration * world.config.period + 1e-12);
    world_end();
}
END_TEST

static double fastest(int ticks)
{
    double most = 0;

    for (int i = 0; i < ticks; i++) {
        world_tick(true);
        for (int j = 0; j < config_arm_joints(&world.config); j++)
            most = fmax(most, fabs(world.outputs.command.velocity[j]));
    }
    return most;
}

START_TEST(a_new_configuration_holds_from_its_tick_on)
{
    static struct config slower;

    begin();
    world_tick(true);
    ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 100});
    ck_assert_double_eq_tol(fastest(500), world.config.motion_arm_velocity, 1e-9);
    slower = world.config;
    slower.motion_arm_velocity = 0.1 * world.config.motion_arm_velocity;
    world.inputs.config = &slower;
    world_tick(true);
    world.inputs.config = NULL;
    fastest(20); /* slows down */
    ck_assert_double_eq_tol(fastest(500), slower.motion_arm_velocity, 1e-9);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        before_any_state_nothing_is_sent,
        requests_that_do_not_fit_are_refused,
        a_repeated_request_is_carried_out_once,
        a_fault_needs_a_reset,
        an_emergency_stops_the_arm_within_the_tick,
        the_loop_goes_on_where_the_watchdog_came_to,
        after_a_long_silence_the_arm_starts_from_rest,
        a_new_configuration_holds_from_its_tick_on,
    };

    return SUITE_RUN("tick", tests);
}
