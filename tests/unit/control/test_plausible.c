/* Encoders that jump or wrap, and two senders of robot states: the arm is held, then it is a fault
 * that says why, and nothing of it is learned. What is honest raises no alarm. */
#include "common/bus/status_words.h"
#include "daemon/control/senses/senders.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

static const reach_status_t *const status = &world.outputs.status;
static struct senders senders;
static struct random_state randoms;

static void begin(const char *robot)
{
    world_begin(fixture_robot_config(robot), 0);
    memset(&senders, 0, sizeof senders);
    randoms = fixture_random("test_plausible");
    world_step();
}

/* A tick on a state that is not the robot's own, as the loop would hand it on; the robot obeys. */
static void tick_on(reach_robot_state_t state)
{
    world.inputs.has_state = true;
    world.inputs.state_age = 0;
    world.inputs.state = state;
    world.inputs.crossed = senders_cross(&senders, &state);
    world_decide();
    world.inputs.n_requests = 0;
    fake_robot_step(&world.robot, &world.outputs.command);
}

static void babble(void)
{
    world_prepare(
        (reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 1000, .seed = 5, .learn = 1});
    for (int i = 0; i < 30; i++)
        tick_on(fake_robot_state(&world.robot));
    ck_assert_int_eq(status->state, REACH_STATUS_T_ACTIVE);
}

static double speed(void)
{
    double most = 0;

    for (int i = 0; i < config_joints(&world.config); i++)
        most = fmax(most, fabs(world.outputs.command.velocity[i]));
    return most;
}

static reach_robot_state_t jumped(int joint, double by)
{
    reach_robot_state_t state = fake_robot_state(&world.robot);

    state.position[joint] += by;
    return state;
}

START_TEST(one_jump_holds_the_arm_for_a_moment)
{
    begin("kobian.yaml");
    babble();
    tick_on(jumped(2, 0.3));
    ck_assert_int_eq(status->state, REACH_STATUS_T_HOLD);
    ck_assert_int_eq(status->refused[REACH_STATUS_T_CHANNEL_STATE][REACH_STATUS_T_JUMP], 1);
    ck_assert_int_eq(status->refused_joint, 3);
    for (int i = 0; i < 10; i++)
        tick_on(fake_robot_state(&world.robot));
    ck_assert_int_eq(status->state, REACH_STATUS_T_ACTIVE);
    ck_assert_int_eq(status->fault, REACH_STATUS_T_FAULT_NONE);
    world_end();
}
END_TEST

START_TEST(a_joint_that_stays_where_it_jumped_is_a_fault_that_names_it)
{
    char text[128];

    begin("kobian.yaml");
    babble();
    for (int i = 0; i < 4; i++)
        tick_on(jumped(2, 0.3));
    ck_assert_int_eq(status->state, REACH_STATUS_T_FAULT);
    status_fault_text(status, text, sizeof text);
    ck_assert_ptr_eq(strstr(text, "a joint jumped: joint 3 by 0."), text);
    ck_assert_double_eq_tol(status->fault_value, 0.3, 0.06);
    for (int i = 0; i < 10; i++)
        tick_on(jumped(2, 0.3));
    ck_assert_double_eq(speed(), 0);
    world_prepare((reach_request_t){.kind = REACH_REQUEST_T_RESET_FAULT});
    for (int i = 0; i < 3; i++) /* it is believed where it is: somebody has looked */
        tick_on(jumped(2, 0.3));
    ck_assert_int_eq(status->state, REACH_STATUS_T_IDLE);
    world_end();
}
END_TEST

/* Within the joint's range or beyond it. */
START_TEST(an_encoder_that_wraps_is_a_fault)
{
    const double wraps[] = {2 * M_PI, -2 * M_PI, M_PI, 0.9};

    for (size_t k = 0; k < sizeof wraps / sizeof wraps[0]; k++) {
        begin("kobian.yaml");
        babble();
        for (int i = 0; i < 4; i++)
            tick_on(jumped(1, wraps[k]));
        ck_assert_int_eq(status->fault, REACH_STATUS_T_FAULT_JUMP);
        ck_assert_int_eq(status->fault_joint, 2);
        world_end();
    }
}
END_TEST

/* The second says mid-range, with numbers of its own: fewer, more, or those of a start. It comes
 * before the first one's state in the tick, after it, or now so and now so. */
static void add_a_second_sender(int64_t first_seq, int order)
{
    reach_robot_state_t second = {.seq = first_seq, .n_joints = config_joints(&world.config)};
    int64_t learned = status->samples;
    int ticks = 0;

    for (int i = 0; i < second.n_joints; i++) {
        struct joint_limits limits = config_joint_limits(&world.config, i);
        second.position[i] = 0.5 * (limits.min + limits.max);
    }
    for (; status->state != REACH_STATUS_T_FAULT; ticks++) {
        reach_robot_state_t own = fake_robot_state(&world.robot);
        bool second_is_last = order == 2 ? random_bits(&randoms) % 2 : order == 1;
        ck_assert_int_lt(ticks, 10);
        second.seq++;
        second.utime = own.utime + (second_is_last ? 9000 : -9000);
        world.inputs.crossed = senders_cross(&senders, second_is_last ? &own : &second);
        int before = world.inputs.crossed;
        world.inputs.state = second_is_last ? second : own;
        world.inputs.has_state = true;
        world.inputs.crossed = before + senders_cross(&senders, &world.inputs.state);
        world_decide();
        fake_robot_step(&world.robot, &world.outputs.command);
    }
    ck_assert_int_le(status->samples, learned);
    ck_assert(status->fault == REACH_STATUS_T_FAULT_SENDERS ||
              status->fault == REACH_STATUS_T_FAULT_JUMP);
    for (int i = 0; i < config_joints(&world.config); i++) {
        struct joint_limits limits = config_joint_limits(&world.config, i);
        ck_assert(world.robot.q[i] >= limits.min && world.robot.q[i] <= limits.max);
    }
}

START_TEST(two_senders_are_a_fault)
{
    const int64_t seqs[] = {0, 7, 1000000};

    for (size_t k = 0; k < sizeof seqs / sizeof seqs[0]; k++)
        for (int order = 0; order < 3; order++) {
            begin("kobian.yaml");
            babble();
            add_a_second_sender(seqs[k], order);
            world_end();
        }
}
END_TEST

/* A second sender that says nearly what the first one says: nothing jumps. */
START_TEST(two_senders_that_agree_are_a_fault_that_says_so)
{
    begin("kobian.yaml");
    babble();
    for (int i = 0; i < 8; i++) {
        reach_robot_state_t state = fake_robot_state(&world.robot);
        if (i % 2) {
            state.seq = 3 + i;
            state.utime += 100;
        }
        tick_on(state);
    }
    ck_assert_int_eq(status->fault, REACH_STATUS_T_FAULT_SENDERS);
    world_end();
}
END_TEST

/* A robot begun anew somewhere else, states lost for half a second, states that overtake each
 * other. */
START_TEST(what_is_honest_is_no_fault)
{
    reach_robot_state_t held[4];

    begin("kobian.yaml");
    babble();
    world.robot.seq = 0;
    world.robot.q[1] += 0.2;
    for (int i = 0; i < 10; i++)
        tick_on(fake_robot_state(&world.robot));
    ck_assert_int_eq(status->state, REACH_STATUS_T_ACTIVE);
    for (int i = 0; i < 10; i++)
        tick_on(fake_robot_state(&world.robot));
    for (int round = 0; round < 20; round++) {
        for (int i = 0; i < 25; i++) {
            world.inputs.state_age += world.config.period;
            world.inputs.crossed = 0;
            world_tick(false);
        }
        for (int i = 0; i < 4; i++) {
            held[i] = fake_robot_state(&world.robot);
            fake_robot_step(&world.robot, &(reach_robot_command_t){0});
        }
        for (int i = 3; i >= 0; i--)
            tick_on(held[i]);
        for (int i = 0; i < 20; i++)
            tick_on(fake_robot_state(&world.robot));
    }
    ck_assert_int_eq(status->fault, REACH_STATUS_T_FAULT_NONE);
    ck_assert_int_eq(status->refused[REACH_STATUS_T_CHANNEL_STATE][REACH_STATUS_T_JUMP], 0);
    world_end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        one_jump_holds_the_arm_for_a_moment,
        a_joint_that_stays_where_it_jumped_is_a_fault_that_names_it,
        an_encoder_that_wraps_is_a_fault,
        two_senders_are_a_fault,
        two_senders_that_agree_are_a_fault_that_says_so,
        what_is_honest_is_no_fault,
    };

    return SUITE_RUN("plausible", tests);
}
