/* Whatever the loop tells the control step, by chance here, a replay of what was recorded repeats.
 */
#include "common/base/checksum.h"
#include "daemon/bus/incoming.h"
#include "daemon/bus/outgoing.h"
#include "daemon/config/text.h"
#include "daemon/replay/replay.h"
#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"
#include "tools/bench/fake_robot.h"

#include <math.h>
#include <reach_marker_t.h>
#include <string.h>

enum { TICKS = 1500, ASK_EVERY = 60 };

static struct config config;
static struct arena *arena;
static struct tick *tick;
static struct fake_robot robot;
static struct random_state chance;
static struct tick_inputs inputs;
static struct tick_outputs outputs;
static struct outgoing_messages out;
static struct replay *replay;
static int64_t waited; /* ticks at whose end a sample waited */

static void say(const char *channel, const void *data, int size)
{
    char error[512];

    ck_assert_int_gt(size, 0);
    ck_assert_msg(replay_take(replay, channel, data, (size_t)size, 0, error, sizeof error) == 0,
                  "%s", error);
}

static void begin(void)
{
    static const char *const overrides[] = {"learner.capacity=4", "learner.degree=1",
                                            "fixation.timeout=1"};
    const struct replay_settings settings = {.verify = true};
    static reach_config_t message;
    static unsigned char bytes[sizeof message + 8];

    config = fixture_config(overrides, 3);
    tick = fixture_tick(&config, &arena);
    replay = replay_create(&settings);
    ck_assert_ptr_nonnull(replay);
    fake_robot_init(&robot, &config);
    outgoing_init(&out, NULL, "");
    config_message(&config, &message);
    say("REACH_CONFIG", bytes, reach_config_t_encode(bytes, 0, sizeof bytes, &message));
}

static bool by_chance(double probability)
{
    return random_uniform(&chance, 0, 1) < probability;
}

static void hear_state(void)
{
    unsigned char bytes[sizeof(reach_robot_state_t) + 8];
    reach_robot_state_t state = fake_robot_state(&robot);
    int size = reach_robot_state_t_encode(bytes, 0, sizeof bytes, &state);

    say("ROBOT_STATE", bytes, size);
    inputs.has_state = true;
    inputs.state_checksum = checksum_crc32(bytes, (size_t)size);
    ck_assert(incoming_state(bytes, (size_t)size, &inputs.state));
}

static void hear_marker(void)
{
    unsigned char bytes[sizeof(reach_marker_t) + 8];
    const reach_marker_t marker = {.utime = robot.marker.utime,
                                   .seq = robot.marker.seq,
                                   .seen = robot.marker.seen,
                                   .u_right = robot.marker.value[0],
                                   .v_right = robot.marker.value[1],
                                   .disparity = robot.marker.value[2]};
    int size = reach_marker_t_encode(bytes, 0, sizeof bytes, &marker);

    say("MARKER", bytes, size);
    ck_assert(incoming_observation(SPACE_VISUAL, bytes, (size_t)size,
                                   &inputs.observation[inputs.n_observations++]));
}

static void hear_request(reach_request_t request)
{
    unsigned char bytes[sizeof request + 8];
    int size = reach_request_t_encode(bytes, 0, sizeof bytes, &request);

    say("REACH_REQUEST", bytes, size);
    inputs.request_checksum[inputs.n_requests] = checksum_crc32(bytes, (size_t)size);
    ck_assert(incoming_request(bytes, (size_t)size, &inputs.request[inputs.n_requests++]));
}

static void gather_inputs(int64_t number)
{
    memset(&inputs, 0, sizeof inputs);
    inputs.state_age = by_chance(0.02) ? random_uniform(&chance, 0, 0.2) : 0.003;
    if (by_chance(0.95))
        hear_state();
    if (robot.has_marker && by_chance(0.9))
        hear_marker();
    if (number % ASK_EVERY == 2) {
        hear_request((reach_request_t){.seq = number, .kind = REACH_REQUEST_T_RESET_FAULT});
        hear_request((reach_request_t){.seq = number + 1,
                                       .kind = REACH_REQUEST_T_BABBLE,
                                       .learn = 1,
                                       .count = 1000,
                                       .seed = number});
    }
    inputs.overrunning = by_chance(0.002);
    inputs.emergency = by_chance(0.002);
    inputs.braked = by_chance(0.005) ? 2 : 0;
    inputs.slipped = by_chance(0.01) ? 3 : 0;
    inputs.robot_rests = by_chance(0.005);
}

static void send(enum outgoing_kind kind, const void *message, size_t size)
{
    static struct outgoing one;

    one.kind = kind;
    memcpy(&one.command, message, size);
    say(outgoing_channel(kind), out.bytes, outgoing_encode(&out, &one));
}

static void step(int64_t number)
{
    gather_inputs(number);
    tick_decide(tick, &inputs, robot.now, &outputs);
    if (by_chance(0.1)) /* as when there is seldom time to learn */
        tick_learn(tick);
    tick_report(tick, robot.now, &outputs);
    waited += outputs.status.queue > 0;
    if (outputs.has_command)
        send(OUTGOING_COMMAND, &outputs.command, sizeof outputs.command);
    if (outputs.has_sample)
        send(OUTGOING_SAMPLE, &outputs.sample, sizeof outputs.sample);
    send(OUTGOING_STATUS, &outputs.status, sizeof outputs.status);
    send(OUTGOING_TRACE, &outputs.trace, sizeof outputs.trace);
    if (outputs.has_command)
        fake_robot_step(&robot, &outputs.command);
}

START_TEST(it_repeats_whatever_happened)
{
    chance = fixture_random("replay");
    begin();
    for (int64_t number = 1; number <= TICKS; number++)
        step(number);
    ck_assert_int_eq(replay_report(replay)->ticks, TICKS);
    ck_assert_int_gt(outputs.status.samples, 0);
    ck_assert_int_gt(waited, 0);
    replay_destroy(replay);
    arena_destroy(arena);
}
END_TEST

/* Ticks without a robot, which nobody logs. */
static void wait_for_a_robot(int n)
{
    for (int i = 0; i < n; i++) {
        memset(&inputs, 0, sizeof inputs);
        inputs.state_age = INFINITY;
        tick_decide(tick, &inputs, robot.now, &outputs);
        tick_report(tick, robot.now, &outputs);
    }
}

/* The number of the second run's first trace goes on where those of the first one's end. */
START_TEST(a_run_that_begins_late_is_not_the_one_before)
{
    enum { FIRST = 10, SILENT = 30, SECOND = 20 };
    struct arena *before;

    chance = fixture_random("replay");
    begin();
    for (int64_t number = 1; number <= FIRST; number++)
        step(number);
    before = arena;
    tick = fixture_tick(&config, &arena);
    fake_robot_init(&robot, &config);
    wait_for_a_robot(SILENT);
    for (int64_t number = 1; number <= SECOND; number++)
        step(number);
    ck_assert_int_eq(replay_report(replay)->runs, 2);
    ck_assert_int_eq(replay_report(replay)->ticks, FIRST + SECOND);
    replay_destroy(replay);
    arena_destroy(arena);
    arena_destroy(before);
}
END_TEST

START_TEST(losses_are_told_by_run)
{
    static const struct replay_settings settings = {.lossy = true};
    static reach_config_t message;
    static unsigned char bytes[sizeof message + 8];
    reach_trace_t trace;

    begin();
    replay_destroy(replay);
    replay = replay_create(&settings);
    config_message(&config, &message);
    say("REACH_CONFIG", bytes, reach_config_t_encode(bytes, 0, sizeof bytes, &message));
    for (int run = 0; run < 2; run++)
        for (int64_t seq = 1; seq <= 5; seq += 1 + run) {
            trace = (reach_trace_t){.seq = seq,
                                    .utime = (seq + 100 * run) * 20000,
                                    .fresh = seq == 1,
                                    .config = (int32_t)config.checksum,
                                    .has_state = seq == 3,
                                    .given_state = 7};
            send(OUTGOING_TRACE, &trace, sizeof trace);
        }
    ck_assert_int_eq(replay_report(replay)->runs, 2);
    for (int run = 0; run < 2; run++) {
        const struct replay_lost *lost = replay_report(replay)->run[run].lost;
        ck_assert_int_eq(lost[REPLAY_STATE].n, 1);
        ck_assert_int_eq(lost[REPLAY_STATE].first, 7);
        ck_assert_int_eq(lost[REPLAY_TRACE].n, run == 0 ? 0 : 2);
    }
    replay_destroy(replay);
    arena_destroy(arena);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {it_repeats_whatever_happened,
                                  a_run_that_begins_late_is_not_the_one_before,
                                  losses_are_told_by_run};

    return SUITE_RUN("replay", tests);
}
