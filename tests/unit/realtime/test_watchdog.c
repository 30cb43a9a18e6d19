/* The watch over the loop and its brake, on a real bus: in a network namespace of its own. */
#include "common/base/thread.h"
#include "common/bus/open.h"
#include "daemon/bus/bus.h"
#include "daemon/realtime/watchdog.h"
#include "tests/unit/control/fixture.h"
#include "tests/unit/suite.h"

#include <lcm/lcm.h>
#include <math.h>
#include <reach_robot_command_t.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

enum { HEARD = 256 };

static const double fast = 0.6; /* rad/s */
static struct config config;
static struct arena *arena;
static lcm_t *lcm;
static struct daemon_bus *bus;
static struct watchdog *watchdog;
static reach_robot_command_t heard[HEARD];
static int n_heard;

static void on_command(const lcm_recv_buf_t *message, const char *channel,
                       const reach_robot_command_t *command, void *user)
{
    (void)message, (void)channel, (void)user;
    if (n_heard < HEARD)
        heard[n_heard++] = *command;
}

static void begin(void)
{
    char url[BUS_URL_MOST], error[512] = "";

    config = fixture_config(NULL, 0);
    arena = arena_create(daemon_bus_memory() + watchdog_memory());
    watchdog_take_signal();
    lcm = bus_open(NULL, error, sizeof error);
    ck_assert_msg(lcm != NULL, "%s", error);
    reach_robot_command_t_subscribe(lcm, "ROBOT_COMMAND", on_command, NULL);
    bus = daemon_bus_create(lcm, SPACE_VISUAL, arena, error, sizeof error);
    bus_url(NULL, url, sizeof url);
    watchdog = watchdog_create(&config, bus, url, arena, error, sizeof error);
    ck_assert_msg(watchdog != NULL, "%s", error);
    ck_assert_int_eq(watchdog_start(watchdog, false, error, sizeof error), 0);
}

static void end(void)
{
    watchdog_stop(watchdog);
    while (lcm_handle_timeout(lcm, 20) > 0)
        ;
    lcm_destroy(lcm);
    arena_destroy(arena);
}

static reach_robot_command_t command(void)
{
    return (reach_robot_command_t){
        .utime = 1, .seq = 7, .n_joints = config_joints(&config), .velocity = {fast, -fast}};
}

static void wait_periods(double periods)
{
    sleep_until(bus_monotonic_us() * 1000 + (int64_t)(periods * config.period * 1e9));
}

START_TEST(a_loop_that_stands_still_is_braked_to_rest)
{
    const reach_robot_command_t last = command();
    double step;

    begin();
    step = config_joint_limits(&config, 0).safety_acceleration * config.period;
    watchdog_feed(watchdog, &last);
    ck_assert(!watchdog_await_rest(watchdog, 0.5 * config.safety_loop_stall));
    ck_assert(watchdog_await_rest(watchdog, 5));
    ck_assert_int_ge(watchdog_take_braked(watchdog), (int)ceil(fast / step));
    end();
    ck_assert_int_gt(n_heard, 2);
    ck_assert_int_eq(heard[0].n_joints, last.n_joints);
    for (int i = 0; i < n_heard; i++) {
        double before = i > 0 ? heard[i - 1].velocity[0] : fast;
        ck_assert_double_eq_tol(heard[i].velocity[0], fmax(before - step, 0), 1e-9);
        ck_assert_double_eq_tol(heard[i].velocity[1], -heard[i].velocity[0], 1e-9);
        ck_assert_int_gt(heard[i].utime, last.utime);
    }
    ck_assert_double_eq(heard[n_heard - 1].velocity[0], 0);
}
END_TEST

START_TEST(a_loop_that_moves_is_left_alone)
{
    const reach_robot_command_t last = command();

    begin();
    for (double t = 0; t < 3 * config.safety_loop_stall; t += config.period) {
        watchdog_feed(watchdog, &last);
        wait_periods(1);
    }
    ck_assert_int_eq(watchdog_take_braked(watchdog), 0);
    end();
    ck_assert_int_eq(n_heard, 0);
}
END_TEST

/* Nor is there anything to brake before the loop has sent a command. */
START_TEST(who_was_never_told_to_move_is_not_braked)
{
    begin();
    watchdog_feed(watchdog, NULL);
    ck_assert(watchdog_await_rest(watchdog, 5));
    ck_assert_int_eq(watchdog_take_braked(watchdog), 0);
    end();
    ck_assert_int_eq(n_heard, 0);
}
END_TEST

START_TEST(the_signal_is_an_emergency)
{
    bool emergency = false;

    begin();
    ck_assert(!daemon_bus_take_emergency(bus));
    kill(getpid(), SIGUSR1);
    for (int i = 0; i < 100 && !emergency; i++) {
        watchdog_feed(watchdog, NULL);
        wait_periods(1);
        emergency = daemon_bus_take_emergency(bus);
    }
    ck_assert(emergency);
    ck_assert(!daemon_bus_take_emergency(bus)); /* once */
    end();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_loop_that_stands_still_is_braked_to_rest, a_loop_that_moves_is_left_alone,
        who_was_never_told_to_move_is_not_braked, the_signal_is_an_emergency};

    return SUITE_RUN("watchdog", tests);
}
