#include "fake_robot.h"

#include "daemon/config/space.h"

#include <math.h>
#include <string.h>

void fake_robot_init(struct fake_robot *robot, const struct config *config)
{
    memset(robot, 0, sizeof *robot);
    robot->config = config;
    robot->now = 1000000;
    robot->half_width = 320;
    robot->half_height = 240;
    for (int i = 0; i < config_arm_joints(config); i++)
        robot->q[i] = 0.5 * (config->babble_min.value[i] + config->babble_max.value[i]);
}

void fake_robot_task(const struct fake_robot *robot, const double *q_arm, double *x)
{
    double lift = q_arm[0] + 1.1, side = q_arm[1] + 0.3, roll = q_arm[2], bend = q_arm[3] + 1.1;

    x[0] = -0.1 + 0.8 * side + 0.3 * sin(roll) + 0.1 * bend * side + robot->tool * (1 + 0.3 * bend);
    x[1] = 0.1 - 0.3 * sin(lift) - 0.25 * bend + 0.1 * roll * roll + 0.05 * robot->tool * cos(roll);
    x[2] = 20 + 80 * lift - 60 * sin(bend) + 25 * roll - 40 * robot->tool * cos(side);
}

/* The hand is 10 cm behind the last joint, a tool goes on from there at an angle. */
static void chain_position(const struct fake_robot *robot, double position[3])
{
    const double tip[3] = {0.03 + 0.6 * robot->tool, 0.02, 0.1 + 0.8 * robot->tool};
    struct chain_pose pose;

    chain_at(robot->chain, robot->q, &pose);
    for (int row = 0; row < 3; row++) {
        const double *R = pose.turn[robot->chain->n] + (ptrdiff_t)3 * row;
        position[row] = pose.p[row] + R[0] * tip[0] + R[1] * tip[1] + R[2] * tip[2];
    }
}

void fake_robot_position(const struct fake_robot *robot, double position[3])
{
    const double *q = robot->q;

    if (robot->chain) {
        chain_position(robot, position);
        return;
    }
    double lift = q[0] + 0.3 * q[6], side = 0.6 * q[1] + q[4], bend = 0.9 - q[3];
    double reach = 0.25 + 0.12 * sin(bend + 0.2 * q[2]);

    position[0] = reach * cos(lift) + 0.4 * robot->tool * cos(side);
    position[1] = -0.1 + reach * sin(side) + 0.15 * q[5] + robot->tool * sin(lift);
    position[2] = 0.6 - reach * sin(lift) * cos(side) + 0.1 * q[2] * q[2] + 0.3 * robot->tool;
}

void fake_robot_image(const struct fake_robot *robot, double *image)
{
    const double *q_head = robot->q + config_arm_joints(robot->config);
    double x[SPACE_DIMENSIONS];

    fake_robot_task(robot, robot->q, x);
    /* A pinhole eye in the neck's centre: right of the axis is positive u, below positive v. */
    image[0] = -robot->config->eyes_pixels_per_radian * tan(x[0] - q_head[0]);
    image[1] = robot->config->eyes_pixels_per_radian * tan(x[1] - q_head[1]);
    image[2] = x[2];
}

static double gaussian(struct random_state *random)
{
    double sum = -6;

    for (int i = 0; i < 12; i++)
        sum += random_uniform(random, 0, 1);
    return sum;
}

static void measure(struct fake_robot *robot)
{
    robot->marker = (struct observation){
        .utime = robot->now, .seq = ++robot->marker_seq, .seen = !robot->blind};
    robot->has_marker = true;
    fake_robot_position(robot, robot->marker.value);
    for (int axis = 0; axis < 3; axis++)
        robot->marker.value[axis] += robot->noise * gaussian(&robot->random);
}

static void expose(struct fake_robot *robot)
{
    double image[SPACE_DIMENSIONS];

    fake_robot_image(robot, image);
    robot->marker = (struct observation){.utime = robot->now, .seq = ++robot->marker_seq};
    robot->has_marker = true;
    if (robot->blind || fabs(image[0]) > robot->half_width || fabs(image[1]) > robot->half_height) {
        return;
    }
    robot->marker.seen = 1;
    robot->marker.value[0] = image[0] + robot->noise * gaussian(&robot->random);
    robot->marker.value[1] = image[1] + robot->noise * gaussian(&robot->random);
    robot->marker.value[2] = image[2] + robot->noise * gaussian(&robot->random);
}

reach_robot_state_t fake_robot_state(struct fake_robot *robot)
{
    reach_robot_state_t state = {
        .utime = robot->now, .seq = ++robot->seq, .n_joints = config_joints(robot->config)};

    memcpy(state.position, robot->q, sizeof state.position);
    return state;
}

void fake_robot_tick(struct fake_robot *robot, struct tick *tick, struct tick_inputs *inputs,
                     struct tick_outputs *outputs)
{
    inputs->has_state = true;
    inputs->state = fake_robot_state(robot);
    inputs->n_observations = robot->has_marker;
    inputs->observation[0] = robot->marker;
    tick_decide(tick, inputs, robot->now, outputs);
    while (tick_learn(tick))
        ;
    tick_report(tick, robot->now, outputs);
    inputs->n_requests = 0;
}

void fake_robot_step(struct fake_robot *robot, const reach_robot_command_t *command)
{
    if (robot->config->space.kind == SPACE_CARTESIAN)
        measure(robot);
    else
        expose(robot);
    for (int i = 0; i < config_joints(robot->config); i++)
        robot->q[i] += command->velocity[i] * robot->config->period;
    robot->now += (int64_t)(robot->config->period * 1e6);
}
