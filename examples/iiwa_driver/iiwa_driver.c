/* A KUKA iiwa on reachd's bus, by the messages that Drake's iiwa driver and simulations speak:
 * IIWA_STATUS comes from the arm 200 to 1,000 times a second; each is answered with an IIWA_COMMAND
 * of positions, and told to reachd as ROBOT_STATE. reachd's velocities become positions in
 * ../motion/. Where the hand is, a tracking system tells (END_EFFECTOR), or the eyes do. */
#include "../motion/motion.h"

#include <drake_lcmt_iiwa_command.h>
#include <drake_lcmt_iiwa_status.h>
#include <errno.h>
#include <getopt.h>
#include <lcm/lcm.h>
#include <poll.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define RAD(degrees) ((degrees)*3.14159265358979323846 / 180)

enum { JOINTS = 7 };

/* Of the LBR iiwa 7 R800 and 14 R820, from KUKA's data sheet: the ranges are the same, the speeds
 * are those of the slower 14. Two degrees before its ends the arm is stopped by its own controller.
 */
static const double range[JOINTS] = {RAD(168), RAD(118), RAD(168), RAD(118),
                                     RAD(168), RAD(118), RAD(173)};
static const double speed[JOINTS] = {RAD(85),  RAD(85),  RAD(100), RAD(75),
                                     RAD(130), RAD(135), RAD(135)};

static const int silence_ms = 1000; /* after which it is said that no status comes */

struct driver {
    lcm_t *arm, *bus;
    struct motion *motion;
    int64_t seq;      /* of states */
    int64_t statuses; /* that came */
    int64_t refused;  /* statuses that are none: another number of joints, or not finite */
    int64_t said;     /* when it was said that a joint is held, us; 0 = never */
};

static const char usage[] =
    "usage: iiwa_driver [--arm-url URL] [--lcm-url URL] [--speed SHARE]\n"
    "                   [--acceleration RAD/S2] [--leash RAD] [--rate HZ]\n"
    "Puts a KUKA iiwa that speaks Drake's messages on reachd's bus.\n"
    "  --arm-url URL          the LCM bus of IIWA_STATUS and IIWA_COMMAND\n"
    "  --lcm-url URL          the LCM bus of reachd; both default to LCM's on this machine\n"
    "  --speed SHARE          of the arm's fastest velocities, 0.01 .. 1 (default 0.8)\n"
    "  --acceleration RAD/S2  of every joint, 0.1 .. 20 (default 4)\n"
    "  --rate HZ              of IIWA_STATUS at least, 20 .. 1000 (default 200)\n"
    "  --leash RAD            most distance of the set-point from the arm, 0.01 .. 1\n"
    "                         (default 0.15)\n";

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

static void on_command(const lcm_recv_buf_t *message, const char *channel,
                       const reach_robot_command_t *command, void *user)
{
    struct driver *driver = user;

    (void)message;
    (void)channel;
    motion_command(driver->motion, command->n_joints, command->velocity, clock_us(CLOCK_MONOTONIC));
}

/* To reachd, by our clock: the robot's may be a simulator's. */
static void tell(struct driver *driver, const drake_lcmt_iiwa_status *status)
{
    reach_robot_state_t state = {.utime = clock_us(CLOCK_REALTIME), .n_joints = JOINTS};

    state.seq = ++driver->seq;
    memcpy(state.position, status->joint_position_measured, sizeof(double) * JOINTS);
    memcpy(state.velocity, status->joint_velocity_estimated, sizeof(double) * JOINTS);
    reach_robot_state_t_publish(driver->bus, "ROBOT_STATE", &state);
}

/* Once a second. */
static void say_leash(struct driver *driver)
{
    int joint = motion_leashed(driver->motion);
    int64_t now = clock_us(CLOCK_MONOTONIC);

    if (joint == 0 || (driver->said > 0 && now - driver->said < 1000000))
        return;
    driver->said = now;
    fprintf(stderr, "iiwa_driver: joint %d does not follow; is it held, or --leash too short?\n",
            joint);
}

static void on_status(const lcm_recv_buf_t *message, const char *channel,
                      const drake_lcmt_iiwa_status *status, void *user)
{
    struct driver *driver = user;
    double position[JOINTS], velocity[JOINTS];
    drake_lcmt_iiwa_command command = {
        .utime = status->utime, .num_joints = JOINTS, .joint_position = position};

    (void)message;
    (void)channel;
    if (status->num_joints != JOINTS ||
        !motion_step(driver->motion, status->joint_position_measured, NULL, NULL, status->utime,
                     clock_us(CLOCK_MONOTONIC), position, velocity)) {
        if (driver->refused++ == 0)
            fprintf(stderr,
                    "iiwa_driver: an IIWA_STATUS is refused: it must be of %d joints, at "
                    "finite positions\n",
                    JOINTS);
        return;
    }
    driver->statuses++;
    drake_lcmt_iiwa_command_publish(driver->arm, "IIWA_COMMAND", &command);
    tell(driver, status);
    say_leash(driver);
}

static void drain(lcm_t *lcm)
{
    while (lcm_handle_timeout(lcm, 0) > 0)
        continue;
}

/* Commands before the status that they are for. Returns 0, or -1 when the bus is gone. */
static int serve(struct driver *driver)
{
    struct pollfd inputs[] = {{.fd = lcm_get_fileno(driver->arm), .events = POLLIN},
                              {.fd = lcm_get_fileno(driver->bus), .events = POLLIN}};
    int64_t heard = clock_us(CLOCK_MONOTONIC), statuses = 0;

    while (!stop) {
        if (poll(inputs, 2, silence_ms) < 0 && errno != EINTR)
            return -1;
        drain(driver->bus);
        drain(driver->arm);
        if (driver->statuses != statuses) {
            statuses = driver->statuses;
            heard = clock_us(CLOCK_MONOTONIC);
        } else if (clock_us(CLOCK_MONOTONIC) - heard > (int64_t)silence_ms * 1000) {
            fprintf(stderr,
                    "iiwa_driver: no IIWA_STATUS comes; does the arm's program run, on this "
                    "bus?\n");
            heard = INT64_MAX - (int64_t)silence_ms * 1000; /* until one comes */
        }
    }
    return 0;
}

/* Returns 0, or -1 having said why. */
static int open_buses(struct driver *driver, const char *arm_url, const char *bus_url)
{
    driver->arm = lcm_create(arm_url);
    driver->bus = lcm_create(bus_url);
    if (!driver->arm || !driver->bus) {
        fprintf(stderr, "iiwa_driver: LCM cannot be opened at %s\n",
                driver->arm ? bus_url : arm_url);
        return -1;
    }
    drake_lcmt_iiwa_status_subscription_set_queue_capacity(
        drake_lcmt_iiwa_status_subscribe(driver->arm, "IIWA_STATUS", on_status, driver), 1000);
    reach_robot_command_t_subscribe(driver->bus, "ROBOT_COMMAND", on_command, driver);
    return 0;
}

struct settings {
    const char *arm_url, *bus_url;
    double share, acceleration, leash, rate;
};

static struct motion *make_motion(const struct settings *settings)
{
    double lowest[JOINTS], fastest[JOINTS], accelerations[JOINTS];

    for (int i = 0; i < JOINTS; i++) {
        lowest[i] = -range[i];
        fastest[i] = settings->share * speed[i];
        accelerations[i] = settings->acceleration;
    }
    return motion_create(JOINTS, lowest, range, fastest, accelerations, settings->leash,
                         1 / settings->rate);
}

/* A number of an option. Returns 0, or -1 having said why. */
static int number(const char *name, double least, double most, double *value)
{
    char *end;

    *value = strtod(optarg, &end);
    if (end != optarg && *end == '\0' && *value >= least && *value <= most)
        return 0;
    fprintf(stderr, "iiwa_driver: --%s %s must be within %g .. %g\n", name, optarg, least, most);
    return -1;
}

/* Returns 0, 1 when help was asked for, or -1 having said why. */
static int parse(int argc, char **argv, struct settings *settings)
{
    static const struct option options[] = {{"arm-url", required_argument, NULL, 'u'},
                                            {"lcm-url", required_argument, NULL, 'l'},
                                            {"speed", required_argument, NULL, 's'},
                                            {"acceleration", required_argument, NULL, 'a'},
                                            {"leash", required_argument, NULL, 'd'},
                                            {"help", no_argument, NULL, 'h'},
                                            {NULL, 0, NULL, 0}};
    int failed = 0, option;

    while (!failed && (option = getopt_long(argc, argv, "h", options, NULL)) != -1) {
        if (option == 'u')
            settings->arm_url = optarg;
        else if (option == 'l')
            settings->bus_url = optarg;
        else if (option == 's')
            failed = number("speed", 0.01, 1, &settings->share);
        else if (option == 'a')
            failed = number("acceleration", 0.1, 20, &settings->acceleration);
        else if (option == 'd')
            failed = number("leash", 0.01, 1, &settings->leash);
        else if (option == 'r')
            failed = number("rate", 20, 1000, &settings->rate);
        else
            return option == 'h' ? 1 : -1;
    }
    return failed || optind < argc ? -1 : 0;
}

int main(int argc, char **argv)
{
    static const char here[] = "udpm://239.255.76.67:7667?ttl=0";
    struct settings settings = {here, here, 0.8, 4, 0.15, 200};
    struct driver driver = {.seq = 0};
    struct sigaction action = {.sa_handler = on_signal};
    int parsed = parse(argc, argv, &settings), failed;

    if (parsed) {
        fputs(usage, parsed > 0 ? stdout : stderr);
        return parsed > 0 ? EXIT_SUCCESS : 2;
    }
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    driver.motion = make_motion(&settings);
    if (!driver.motion || open_buses(&driver, settings.arm_url, settings.bus_url))
        return EXIT_FAILURE;
    failed = serve(&driver);
    lcm_destroy(driver.arm);
    lcm_destroy(driver.bus);
    motion_destroy(driver.motion);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
