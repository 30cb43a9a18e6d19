/* The fake robot of the unit tests on an LCM bus, in lockstep: it publishes where its joints are
 * and what its eyes see, or where its end-effector is, and waits for the command and the status of
 * that tick before it moves on. It asks the daemon to babble for ever. */
#ifndef REACH_TEST_ROBOT_ON_BUS_H
#define REACH_TEST_ROBOT_ON_BUS_H

#include "tools/bench/fake_robot.h"

#include <lcm/lcm.h>
#include <reach_request_t.h>
#include <reach_sample_t.h>
#include <reach_status_t.h>
#include <stdbool.h>

typedef void robot_sample_fn(void *user, const reach_sample_t *sample);

struct robot_on_bus {
    struct fake_robot robot;
    lcm_t *lcm;
    reach_robot_command_t command; /* newest */
    reach_status_t status;         /* newest */
    reach_request_t request;
    robot_sample_fn *take; /* a training sample that the daemon is about to learn */
    void *user;
};

/* Ends the program when there is no bus. */
void robot_on_bus_init(struct robot_on_bus *robot, const struct config *config,
                       robot_sample_fn *take, void *user);

/* Handles what has come, waiting at most so long. Returns false when nothing came. */
bool robot_on_bus_listen(struct robot_on_bus *robot, int milliseconds);

/* Publishes the present state, again if need be. Returns whether it has been answered. */
bool robot_on_bus_ask(struct robot_on_bus *robot, int milliseconds);

/* A period passes under the newest command. */
void robot_on_bus_move(struct robot_on_bus *robot);

/* Sends a request, under a number of its own. */
void robot_on_bus_request(struct robot_on_bus *robot, int kind, int count);

#endif
