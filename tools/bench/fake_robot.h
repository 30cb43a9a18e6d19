/* A robot without bodies, for tests of the control step: ideal velocity motors, and eyes that see
 * where a made-up smooth map of the arm's joints puts the marker. What it computes has nothing in
 * common with the daemon's learner, but where a test gives it a chain. */
#ifndef REACH_TOOLS_BENCH_FAKE_ROBOT_H
#define REACH_TOOLS_BENCH_FAKE_ROBOT_H

#include "common/base/random.h"
#include "daemon/config/config.h"
#include "daemon/config/sizes.h"
#include "daemon/control/senses/observation.h"
#include "daemon/control/tick.h"
#include "learner/body/chain/chain.h"

#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <stdbool.h>
#include <stdint.h>

struct fake_robot {
    const struct config *config;
    int64_t now; /* us */
    int64_t seq; /* of states */
    int64_t marker_seq;
    double q[MAX_JOINTS];           /* rad */
    double tool;                    /* length of what it holds; 0 = hand */
    double noise;                   /* of what is seen, standard deviation, px or m */
    const struct chain *chain;      /* its arm, of a Cartesian robot; NULL = a made-up map */
    bool blind;                     /* the marker is hidden */
    double half_width, half_height; /* of the image, px */
    struct random_state random;
    bool has_marker;           /* `marker` is new in this period */
    struct observation marker; /* exposed a period before, as late cameras do */
};

void fake_robot_init(struct fake_robot *robot, const struct config *config);

/* Where the end-effector is of a robot whose task space is Cartesian (seven arm joints), m. */
void fake_robot_position(const struct fake_robot *robot, double position[3]);

/* Where the marker is: [yaw rad, pitch rad, disparity px] of the head that would fixate it. */
void fake_robot_task(const struct fake_robot *robot, const double *q_arm, double *x);

/* What the right eye sees now, without noise: [u, v, disparity]. */
void fake_robot_image(const struct fake_robot *robot, double *image);

/* The encoders now. */
reach_robot_state_t fake_robot_state(struct fake_robot *robot);

/* One control step on what the robot tells now, with the requests that are in `inputs`; all samples
 * that wait are learned. */
void fake_robot_tick(struct fake_robot *robot, struct tick *tick, struct tick_inputs *inputs,
                     struct tick_outputs *outputs);

/* One period passes under a command. The marker of the exposure before it becomes available. */
void fake_robot_step(struct fake_robot *robot, const reach_robot_command_t *command);

#endif
