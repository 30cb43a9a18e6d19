/* Hours of bad weather on the control step, by chance: states late, lost, overtaken and not
 * numbers, commands late, the loop standing still, clocks that jump, markers and requests of random
 * bytes, emergencies. The robot obeys and has no hard stops. No command violates a limit, no joint
 * leaves its range, no state of the supervisor is left without an exit.
 *
 * REACH_TEST_MINUTES is the simulated time, 60 by default. */
#include "daemon/control/tick.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "tools/bench/fake_robot.h"

#include "daemon/control/limits/safety.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JOINTS 6
#define IN_FLIGHT 16
#define EPISODE 1500 /* ticks */

/* In periods: the first two together stay within safety.latency, the third within safety.reaction.
 */
enum { STATE_LATE = 1, COMMAND_LATE = 1, STANDSTILL = 6 };

static struct config config;
static struct tick *tick;
static struct fake_robot robot;
static struct random_state chance;
static struct tick_inputs inputs;
static struct tick_outputs outputs;

static reach_robot_state_t in_flight[IN_FLIGHT];
static int arrives[IN_FLIGHT];                         /* tick of the episode, -1 = empty */
static reach_robot_command_t issued[COMMAND_LATE + 1]; /* newest first */
static int behind;                                     /* which of them the robot obeys */
static double last[JOINTS];                            /* newest command, to see its change */
static int outage;                                     /* periods in which no state arrives */
static double age;
static int64_t clock_offset, request_seq;
static int visits[8];

static bool happens(double share)
{
    return random_uniform(&chance, 0, 1) < share;
}

static int up_to(int most)
{
    return (int)(random_bits(&chance) % (uint64_t)(most + 1));
}

static void spoil(void *bytes, size_t size, int times)
{
    for (int i = 0; i < times; i++)
        ((unsigned char *)bytes)[random_bits(&chance) % size] = (unsigned char)random_bits(&chance);
}

static void spoil_state(reach_robot_state_t *state)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e9, -50};

    if (happens(0.2))
        state->n_joints = up_to(20) == JOINTS ? 0 : 17;
    else
        state->position[up_to(JOINTS - 1)] = bad[up_to(4)];
}

/* The robot measures; the state is on its way. */
static void send_state(int now, bool late)
{
    int slot = 0;

    if (happens(0.05))
        return; /* lost */
    while (slot < IN_FLIGHT - 1 && arrives[slot] >= 0)
        slot++;
    in_flight[slot] = fake_robot_state(&robot);
    arrives[slot] = now + (late ? up_to(STATE_LATE) : 0);
    if (happens(0.03))
        spoil_state(&in_flight[slot]);
}

/* The last of those that arrive in this tick counts, in an order by chance. */
static void receive_states(int now)
{
    int first = up_to(IN_FLIGHT - 1);

    inputs.has_state = false;
    if (outage > 0)
        outage--;
    for (int i = 0; i < IN_FLIGHT; i++) {
        int slot = (first + i) % IN_FLIGHT;
        if (arrives[slot] < 0 || arrives[slot] > now)
            continue;
        arrives[slot] = -1;
        if (outage > 0)
            continue;
        inputs.has_state = true;
        inputs.state = in_flight[slot];
    }
    age = inputs.has_state ? 0 : age + config.period;
    inputs.state_age = age;
}

static void random_request(reach_request_t *request)
{
    *request = (reach_request_t){.seq = ++request_seq,
                                 .kind = (int8_t)up_to(REACH_REQUEST_T_EMERGENCY),
                                 .learn = 1,
                                 .count = 1 + up_to(5),
                                 .seed = (int64_t)random_bits(&chance),
                                 .n_targets = 1 + up_to(3),
                                 .period = random_uniform(&chance, 0.1, 2)};
    if (request->kind == REACH_REQUEST_T_EMERGENCY && happens(0.9))
        request->kind = REACH_REQUEST_T_BABBLE;
    if (request->kind == REACH_REQUEST_T_REACH || request->kind == REACH_REQUEST_T_COORDINATE)
        request->count = up_to(1);
    for (int i = 0; i < request->n_targets; i++) {
        request->target[i][0] = random_uniform(&chance, -200, 200);
        request->target[i][1] = random_uniform(&chance, -200, 200);
        request->target[i][2] = random_uniform(&chance, -50, 50);
    }
    if (happens(0.1))
        spoil(request, sizeof *request, 20);
}

static void bad_weather(void)
{
    inputs.n_observations = robot.has_marker;
    inputs.observation[0] = robot.marker;
    if (happens(0.05)) {
        inputs.n_observations = up_to(TICK_MAX_OBSERVATIONS);
        spoil(inputs.observation, sizeof inputs.observation, 60);
    }
    inputs.n_requests = happens(0.02);
    if (inputs.n_requests)
        random_request(&inputs.request[0]);
    inputs.overrunning = happens(0.0005);
    inputs.emergency = happens(0.0005);
    if (happens(0.002))
        outage = up_to(50);
    if (happens(0.001))
        clock_offset = (int64_t)random_uniform(&chance, -1e10, 1e10);
    if (happens(0.0005)) /* the robot's own clock is set */
        robot.now = 1000000 + (int64_t)random_uniform(&chance, 0, 1e10);
}

/* A command leaves: it is looked at, and the robot obeys it or one a little older for a period. */
static void obey(const reach_robot_command_t *command, bool late)
{
    for (int i = 0; i < JOINTS; i++) {
        struct joint_limits limits = config_joint_limits(&config, i);
        double v = command->velocity[i];
        /* Not ck_assert: Check writes each one that holds to a pipe, here millions. */
        if (!(fabs(v) <= limits.safety_velocity + 1e-12))
            ck_abort_msg("joint %d: velocity %g", i, v);
        if (!(fabs(v - last[i]) <= limits.safety_acceleration * config.period + 1e-9))
            ck_abort_msg("joint %d: velocity from %g to %g", i, last[i], v);
        if (!(robot.q[i] >= limits.min - 1e-9 && robot.q[i] <= limits.max + 1e-9))
            ck_abort_msg("joint %d at %g", i, robot.q[i]);
        last[i] = v;
    }
    memmove(issued + 1, issued, sizeof issued - sizeof issued[0]);
    issued[0] = *command;
    behind = late ? up_to(behind + 1 < COMMAND_LATE ? behind + 1 : COMMAND_LATE) : 0;
    fake_robot_step(&robot, &issued[behind]);
}

/* The loop stands still: the last command holds, then the watchdog brakes. */
static void stand_still(int now)
{
    reach_robot_command_t braking = outputs.command;
    int braked = up_to(10);

    for (int i = 0; i < STANDSTILL; i++) {
        fake_robot_step(&robot, &braking);
        send_state(now, false);
    }
    for (int i = 0; i < braked; i++) {
        safety_brake(&config, braking.velocity);
        obey(&braking, false);
        send_state(now, false);
    }
    inputs.braked = braked;
    inputs.slipped = STANDSTILL;
}

static void run_tick(void)
{
    int64_t now = robot.now + clock_offset;

    tick_decide(tick, &inputs, now, &outputs);
    tick_learn(tick);
    tick_report(tick, now, &outputs);
    visits[outputs.status.state]++;
}

static void bad_period(int now, bool late)
{
    send_state(now, late);
    receive_states(now);
    bad_weather();
    run_tick();
    inputs.braked = 0;
    inputs.slipped = 0;
    if (!outputs.has_command)
        return;
    obey(&outputs.command, late);
    if (!late && happens(0.01))
        stand_still(now);
}

static void calm_period(int kind)
{
    /* A standstill may have been the last thing that happened. */
    inputs = (struct tick_inputs){.has_state = true,
                                  .n_requests = kind >= 0,
                                  .braked = inputs.braked,
                                  .slipped = inputs.slipped};
    inputs.state = fake_robot_state(&robot);
    inputs.request[0] =
        (reach_request_t){.seq = ++request_seq, .kind = (int8_t)kind, .count = 2, .seed = 1};
    run_tick();
    inputs.braked = 0;
    inputs.slipped = 0;
    obey(&outputs.command, false);
}

/* Whatever happened: in good weather the user gets the robot back. */
static void come_to_rest(void)
{
    outage = 0;
    age = 0;
    for (int i = 0; i < IN_FLIGHT; i++)
        arrives[i] = -1;
    calm_period(REACH_REQUEST_T_STOP);
    calm_period(REACH_REQUEST_T_RESET_FAULT);
    calm_period(-1);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_IDLE);
    calm_period(REACH_REQUEST_T_BABBLE);
    ck_assert_int_eq(outputs.status.state, REACH_STATUS_T_ACTIVE);
    for (int i = 0; i < 15; i++)
        calm_period(i == 0 ? REACH_REQUEST_T_STOP : -1);
    for (int i = 0; i < JOINTS; i++)
        ck_assert_double_eq(outputs.command.velocity[i], 0);
}

static void begin(void)
{
    struct arena *arena;

    chance = fixture_random("test_limits");
    config = fixture_config(NULL, 0);
    tick = fixture_tick(&config, &arena);
    fake_robot_init(&robot, &config);
    robot.random = chance;
    for (int i = 0; i < IN_FLIGHT; i++)
        arrives[i] = -1;
    age = INFINITY;
}

START_TEST(in_bad_weather_every_limit_holds)
{
    const char *minutes = getenv("REACH_TEST_MINUTES");
    double ticks = (minutes ? atof(minutes) : 60) * 60 / 0.02;

    begin();
    for (int episode = 0; episode < ticks / EPISODE; episode++) {
        for (int now = 0; now < EPISODE; now++)
            bad_period(now, episode % 2 == 0);
        come_to_rest();
    }
    printf("test_limits: ticks in each state:");
    for (int state = 0; state <= REACH_STATUS_T_FAULT; state++) {
        printf(" %d", visits[state]);
        ck_assert_int_gt(visits[state], 0);
    }
    printf("; %lld commands gated\n", (long long)outputs.status.gated);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {in_bad_weather_every_limit_holds};

    return suite_run("limits", tests, 1, 36000);
}
