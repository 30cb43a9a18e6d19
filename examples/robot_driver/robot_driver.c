/* A robot's driver: puts a robot of yours in the simulator's place. It publishes what the encoders
 * say, 50 times a second, and obeys the newest command as long as it is fresh. It knows nothing of
 * reachd but the messages in lcmtypes/.
 *
 * A driver is the last before the motors, so it trusts nobody: what is not finite, too fast, too
 * old, or would leave a joint's range does not get through. */
#include "robot.h"

#include <errno.h>
#include <lcm/lcm.h>
#include <math.h>
#include <reach_end_effector_t.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const int64_t period_us = 20000;
static const int64_t command_age_us = 100000; /* without a command for so long, the robot holds */

struct driver {
    lcm_t *lcm;
    int64_t seq;         /* of states */
    int64_t measurement; /* seq of end-effector positions */
    int64_t commanded;   /* when the newest good command came, CLOCK_MONOTONIC us; 0 = never */
    double velocity[ROBOT_JOINTS];
};

static volatile sig_atomic_t stop;

static void on_signal(int number)
{
    (void)number;
    stop = 1;
}

static int64_t clock_us(clockid_t clock)
{
    struct timespec now;

    clock_gettime(clock, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

/* A command that is no command at all is as good as none. */
static void on_command(const lcm_recv_buf_t *message, const char *channel,
                       const reach_robot_command_t *command, void *user)
{
    struct driver *driver = (struct driver *)user;

    (void)message;
    (void)channel;
    if (command->n_joints != ROBOT_JOINTS)
        return;
    for (int i = 0; i < ROBOT_JOINTS; i++)
        if (!isfinite(command->velocity[i]))
            return;
    memcpy(driver->velocity, command->velocity, sizeof driver->velocity);
    driver->commanded = clock_us(CLOCK_MONOTONIC);
}

/* The velocity that joint `i` at `position` may have. */
static double allowed(int i, double position, double velocity)
{
    double v = fmax(-robot_fastest[i], fmin(robot_fastest[i], velocity));
    double next = position + v * (double)period_us * 1e-6;

    return (next < robot_lowest[i] && v < 0) || (next > robot_highest[i] && v > 0) ? 0 : v;
}

static int obey(struct driver *driver, const double *position)
{
    double velocity[ROBOT_JOINTS] = {0};

    if (clock_us(CLOCK_MONOTONIC) - driver->commanded < command_age_us)
        for (int i = 0; i < ROBOT_JOINTS; i++)
            velocity[i] = allowed(i, position[i], driver->velocity[i]);
    return robot_move(velocity);
}

static void tell(struct driver *driver, const double *position, const double *velocity)
{
    reach_robot_state_t state = {.utime = clock_us(CLOCK_REALTIME), .n_joints = ROBOT_JOINTS};
    reach_end_effector_t effector = {.utime = state.utime};

    state.seq = ++driver->seq;
    memcpy(state.position, position, sizeof(double) * ROBOT_JOINTS);
    memcpy(state.velocity, velocity, sizeof(double) * ROBOT_JOINTS);
    /* The measurement first: it belongs to the state's instant. */
    if (robot_end_effector(effector.position) == 0) {
        effector.seq = ++driver->measurement;
        reach_end_effector_t_publish(driver->lcm, "END_EFFECTOR", &effector);
    }
    reach_robot_state_t_publish(driver->lcm, "ROBOT_STATE", &state);
}

/* One period: what has come, what the robot does, what it is. Returns 0, or -1 when it fails. */
static int step(struct driver *driver)
{
    double position[ROBOT_JOINTS];
    double velocity[ROBOT_JOINTS];

    while (lcm_handle_timeout(driver->lcm, 0) > 0)
        continue;
    if (robot_read(position, velocity) || obey(driver, position))
        return -1;
    tell(driver, position, velocity);
    return 0;
}

/* On the grid of periods, whatever a step takes. Returns 0, or -1 when the robot fails. */
static int drive_on_grid(struct driver *driver)
{
    struct timespec next;

    clock_gettime(CLOCK_MONOTONIC, &next);
    while (!stop) {
        if (step(driver))
            return -1;
        next.tv_nsec += (long)period_us * 1000;
        next.tv_sec += next.tv_nsec / 1000000000;
        next.tv_nsec %= 1000000000;
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL) == EINTR && !stop)
            continue;
    }
    return 0;
}

int main(int argc, char **argv)
{
    struct driver driver = {.lcm = NULL};
    struct sigaction action = {.sa_handler = on_signal};
    int failed;

    if (argc > 2 || (argc == 2 && argv[1][0] == '-')) {
        fprintf(stderr, "usage: robot_driver [LCM_URL]\n");
        return 2;
    }
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    driver.lcm = lcm_create(argc > 1 ? argv[1] : "udpm://239.255.76.67:7667?ttl=0");
    if (!driver.lcm || robot_open()) {
        fprintf(stderr, "robot_driver: the bus or the robot cannot be opened\n");
        return EXIT_FAILURE;
    }
    reach_robot_command_t_subscribe(driver.lcm, "ROBOT_COMMAND", on_command, &driver);
    failed = drive_on_grid(&driver);
    robot_close();
    lcm_destroy(driver.lcm);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
