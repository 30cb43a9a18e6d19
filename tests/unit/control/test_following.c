/* A joint that does not do what it is told, whatever is the cause: noticed in time, with joint and
 * reason. Delays, noise and lost states are no cause. */
#include "daemon/control/senses/following.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <math.h>
#include <string.h>

enum trouble { NONE, ENCODER_STUCK, MOTOR_DEAD, MOTOR_REVERSED, ENCODER_REVERSED, MOTOR_THRICE };
enum { LATEST = 3 };

static const reach_status_t *const status = &world.outputs.status;
static const double fast = 20 * M_PI / 180; /* rad/s */
/* s of motion at that speed: in one piece it takes 0.3, in short moves more of them. */
static const double at_once = 0.8;
static struct random_state randoms;
static enum trouble trouble;
static int joint; /* that has it */
static double turned_at;
static reach_robot_command_t sent[LATEST]; /* newest first */
static int late;                           /* of the commands, ticks */

static void step(void);

/* At rest for a while, as robots are before they are asked. */
static void begin(const char *robot, enum trouble what, int which, int delay)
{
    world_begin(fixture_robot_config(robot), 0);
    trouble = what;
    joint = which;
    late = delay;
    memset(sent, 0, sizeof sent);
    turned_at = world.robot.q[joint];
    for (int i = 0; i < 60; i++)
        step();
}

static reach_robot_state_t measured(void)
{
    reach_robot_state_t state = fake_robot_state(&world.robot);

    for (int i = 0; i < state.n_joints; i++)
        state.position[i] += random_uniform(&randoms, -0.001, 0.001);
    if (trouble == ENCODER_STUCK)
        state.position[joint] = turned_at;
    if (trouble == ENCODER_REVERSED)
        state.position[joint] = 2 * turned_at - state.position[joint];
    return state;
}

/* What a command becomes. */
static double factor(void)
{
    switch (trouble) {
    case MOTOR_DEAD:
        return 0;
    case MOTOR_REVERSED:
        return -1;
    case MOTOR_THRICE:
        return 3;
    default:
        return 1;
    }
}

static void obey(void)
{
    reach_robot_command_t command;

    memmove(sent + 1, sent, sizeof sent - sizeof sent[0]);
    sent[0] = world.outputs.command;
    command = sent[late];
    command.velocity[joint] *= factor();
    fake_robot_step(&world.robot, &command);
}

static void step(void)
{
    bool lost = random_bits(&randoms) % 20 == 0;

    world.inputs.has_state = !lost;
    world.inputs.state_age = lost ? 0.02 : 0;
    if (!lost)
        world.inputs.state = measured();
    world.inputs.n_observations = world.robot.has_marker;
    world.inputs.observation[0] = world.robot.marker;
    tick_decide(world.tick, &world.inputs, world.robot.now, &world.outputs);
    while (tick_learn(world.tick))
        ;
    tick_report(world.tick, world.robot.now, &world.outputs);
    world.inputs.n_requests = 0;
    obey();
}

static void babble(int64_t seed)
{
    world_prepare((reach_request_t){
        .kind = REACH_REQUEST_T_BABBLE, .count = 1000000, .seed = seed, .learn = 1});
}

/* Babbles until the fault. Returns after how long of motion of that joint at speed, s. */
static double noticed_after(void)
{
    int ticks = 0;

    babble(11);
    for (int i = 0; i < 3000; i++) {
        step();
        if (status->state == REACH_STATUS_T_FAULT)
            return ticks * world.config.period;
        ticks += fabs(world.outputs.command.velocity[joint]) > fast;
    }
    return INFINITY;
}

/* In each joint of the arm, with each delay of its commands. While joints are slow, or before it is
 * noticed, no more than so many samples are learned. */
static void assert_noticed(enum trouble what, int8_t fault, int most_learned)
{
    double worst = 0;
    int64_t learned = 0;

    for (int which = 0; which < 4; which++)
        for (int delay = 0; delay < LATEST; delay++) {
            double after;
            begin("kobian.yaml", what, which, delay);
            after = noticed_after();
            worst = fmax(worst, after);
            ck_assert_msg(after <= at_once, "trouble %d of joint %d, delay %d: after %g s",
                          (int)what, which, delay, after);
            ck_assert_int_eq(status->fault_joint, which + 1);
            ck_assert_int_eq(status->fault, fault);
            learned = status->samples > learned ? status->samples : learned;
            ck_assert_int_le(learned, most_learned);
            world_end();
        }
    printf("test_following: trouble %d is noticed after %.2f s, %d samples were learned, at most\n",
           (int)what, worst, (int)learned);
}

START_TEST(a_stuck_encoder_is_noticed)
{
    assert_noticed(ENCODER_STUCK, REACH_STATUS_T_FAULT_STILL, 2);
}
END_TEST

/* The same as a joint that is blocked, or its brake on. */
START_TEST(a_dead_motor_is_noticed)
{
    assert_noticed(MOTOR_DEAD, REACH_STATUS_T_FAULT_STILL, 2);
}
END_TEST

START_TEST(a_wrong_sign_is_noticed)
{
    assert_noticed(MOTOR_REVERSED, REACH_STATUS_T_FAULT_REVERSED, 0);
    assert_noticed(ENCODER_REVERSED, REACH_STATUS_T_FAULT_REVERSED, 0);
}
END_TEST

START_TEST(a_wrong_scale_is_noticed)
{
    assert_noticed(MOTOR_THRICE, REACH_STATUS_T_FAULT_ASTRAY, 40);
}
END_TEST

/* Joint 2 is told to go to and fro at 30 degrees a second, and does so two ticks late, until it
 * does no more. Returns after how long that is noticed, s; -1 = not within a minute. */
static double noticed_when_it_stops(double seconds_before)
{
    struct config config = fixture_config(NULL, 0);
    struct following following;
    double q[MAX_JOINTS] = {0}, velocity[MAX_JOINTS] = {0}, way[3] = {0};
    int before = (int)(seconds_before / config.period);

    following_init(&following, &config);
    for (int i = 0; i < before + 3000; i++) {
        velocity[1] = (i / 50 % 2 ? -30 : 30) * M_PI / 180;
        q[1] += i < before ? way[2] * config.period : 0;
        way[2] = way[1], way[1] = way[0], way[0] = velocity[1];
        following_look(&following, velocity, q);
        if (following.joint && i < before)
            return 0;
        if (following.joint) {
            ck_assert_int_eq(following.joint, 2);
            ck_assert_int_eq(following.fault, FOLLOWING_STILL);
            return (i - before) * config.period;
        }
    }
    return -1;
}

/* A joint that did follow may be held by something, but not for ever. */
START_TEST(what_breaks_later_is_noticed)
{
    double at_first = noticed_when_it_stops(0), later = noticed_when_it_stops(20);

    ck_assert_double_gt(at_first, 0);
    ck_assert_double_le(at_first, 0.5);
    ck_assert_double_gt(later, 10);
    ck_assert_double_le(later, 25); /* turning round, it is not told enough to be judged */
}
END_TEST

START_TEST(after_a_reset_it_is_noticed_again)
{
    begin("kobian.yaml", MOTOR_DEAD, 1, 1);
    ck_assert_double_le(noticed_after(), at_once);
    world_prepare((reach_request_t){.kind = REACH_REQUEST_T_RESET_FAULT});
    for (int i = 0; i < 60; i++)
        step();
    ck_assert_int_eq(status->state, REACH_STATUS_T_IDLE);
    ck_assert_double_le(noticed_after(), at_once);
    world_end();
}
END_TEST

/* Ten minutes of each robot's time for each delay, with noise and lost states. */
START_TEST(an_honest_robot_raises_no_alarm)
{
    const char *const robots[] = {"kobian.yaml", "icub.yaml"};

    for (int robot = 0; robot < 2; robot++)
        for (int delay = 0; delay < LATEST; delay++) {
            begin(robots[robot], NONE, 0, delay);
            babble(delay + 1);
            world.inputs.request[0].learn = 0;
            for (int i = 0; i < 10 * 60 * 50; i++) {
                step();
                ck_assert_int_eq(status->fault, REACH_STATUS_T_FAULT_NONE);
            }
            world_end();
        }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_stuck_encoder_is_noticed,      a_dead_motor_is_noticed,
        a_wrong_sign_is_noticed,         a_wrong_scale_is_noticed,
        what_breaks_later_is_noticed,    after_a_reset_it_is_noticed_again,
        an_honest_robot_raises_no_alarm,
    };

    randoms = fixture_random("test_following");
    return SUITE_RUN("following", tests);
}
