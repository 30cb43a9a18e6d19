#include "robot_on_bus.h"

#include "common/bus/open.h"

#include <reach_end_effector_t.h>
#include <reach_marker_t.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void on_command(const lcm_recv_buf_t *buffer, const char *channel,
                       const reach_robot_command_t *command, void *user)
{
    struct robot_on_bus *robot = user;

    (void)buffer;
    (void)channel;
    robot->command = *command;
}

static void on_status(const lcm_recv_buf_t *buffer, const char *channel,
                      const reach_status_t *status, void *user)
{
    struct robot_on_bus *robot = user;

    (void)buffer;
    (void)channel;
    robot->status = *status;
}

static void on_sample(const lcm_recv_buf_t *buffer, const char *channel,
                      const reach_sample_t *sample, void *user)
{
    struct robot_on_bus *robot = user;

    (void)buffer;
    (void)channel;
    if (sample->learned)
        robot->take(robot->user, sample);
}

void robot_on_bus_init(struct robot_on_bus *robot, const struct config *config,
                       robot_sample_fn *take, void *user)
{
    char error[300];

    fake_robot_init(&robot->robot, config);
    robot->take = take;
    robot->user = user;
    robot->lcm = bus_open(NULL, error, sizeof error);
    if (!robot->lcm) {
        fprintf(stderr, "robot: %s\n", error);
        exit(1);
    }
    reach_robot_command_t_subscribe(robot->lcm, "ROBOT_COMMAND", on_command, robot);
    reach_status_t_subscribe(robot->lcm, "REACH_STATUS", on_status, robot);
    reach_sample_t_subscribe(robot->lcm, "REACH_SAMPLE", on_sample, robot);
    fake_robot_state(&robot->robot); /* states count from 1 */
}

bool robot_on_bus_listen(struct robot_on_bus *robot, int milliseconds)
{
    return lcm_handle_timeout(robot->lcm, milliseconds) > 0;
}

static void publish_marker(lcm_t *lcm, const struct observation *seen)
{
    const reach_marker_t marker = {
        .utime = seen->utime,
        .seq = seen->seq,
        .seen = seen->seen,
        .u_right = seen->value[0],
        .v_right = seen->value[1],
        .disparity = seen->value[2],
    };

    reach_marker_t_publish(lcm, "MARKER", &marker);
}

static void publish_effector(lcm_t *lcm, const struct observation *measured)
{
    reach_end_effector_t effector = {.utime = measured->utime, .seq = measured->seq};

    memcpy(effector.position, measured->value, sizeof effector.position);
    reach_end_effector_t_publish(lcm, "END_EFFECTOR", &effector);
}

static void publish(struct robot_on_bus *robot)
{
    struct fake_robot *body = &robot->robot;
    reach_robot_state_t state;

    body->seq--; /* the same state under the same number */
    state = fake_robot_state(body);
    state.lockstep = 1;
    if (body->has_marker && body->config->space.kind == SPACE_CARTESIAN) {
        state.effector_due = body->marker.utime;
        publish_effector(robot->lcm, &body->marker);
    } else if (body->has_marker) {
        state.vision_due = body->marker.utime;
        publish_marker(robot->lcm, &body->marker);
    }
    reach_robot_state_t_publish(robot->lcm, "ROBOT_STATE", &state);
}

bool robot_on_bus_ask(struct robot_on_bus *robot, int milliseconds)
{
    int64_t end = bus_monotonic_us() + 1000 * (int64_t)milliseconds;

    publish(robot);
    do {
        if (robot->command.state_seq == robot->robot.seq &&
            robot->status.state_seq == robot->robot.seq)
            return true;
    } while (robot_on_bus_listen(robot, 1) || bus_monotonic_us() < end);
    return false;
}

void robot_on_bus_move(struct robot_on_bus *robot)
{
    fake_robot_step(&robot->robot, &robot->command);
    fake_robot_state(&robot->robot);
}

void robot_on_bus_request(struct robot_on_bus *robot, int kind, int count)
{
    robot->request = (reach_request_t){.utime = bus_utime(),
                                       .seq = robot->request.seq + 1,
                                       .kind = (int8_t)kind,
                                       .learn = 1,
                                       .count = count,
                                       .seed = robot->request.seq};
    reach_request_t_publish(robot->lcm, "REACH_REQUEST", &robot->request);
}
