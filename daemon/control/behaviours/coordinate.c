/* Arm-head coordination (paper section 7.2): the head turns to targets, the arm keeps the marker
 * in fixation. */
#include "daemon/control/behaviours/helpers.h"
#include "daemon/control/behaviours/targets.h"
#include "daemon/control/limits/motion.h"

#include <math.h>
#include <reach_status_t.h>
#include <string.h>

struct coordinate {
    struct targets targets;
    double head_goal[HEAD_JOINTS]; /* rad */
};

static bool coordinate_accepts(const struct config *config, const reach_request_t *request)
{
    return config->space.n_head > 0 && targets_accept(config, request);
}

static void coordinate_start(struct behaviour *behaviour, const reach_request_t *request,
                             const struct senses *senses, struct wants *wants)
{
    struct coordinate *coordinate = behaviour_state(behaviour);

    (void)wants;
    targets_begin(&coordinate->targets, &behaviour->progress, request, senses->config);
}

/* The target is virtual: the direction that its pixel has when it is presented, to which the head
 * then turns by its encoders. */
static void present(struct coordinate *coordinate, const struct senses *senses,
                    const double *target)
{
    const struct config *config = senses->config;
    const double *q_head = senses->q + config_arm_joints(config);
    double turn[SPACE_DIMENSIONS];

    space_to_task(&config->space, target, turn);
    for (int i = 0; i < HEAD_JOINTS; i++)
        coordinate->head_goal[i] =
            fmin(fmax(q_head[i] + turn[i], config->head_min.value[i] + config->motion_margin),
                 config->head_max.value[i] - config->motion_margin);
}

/* Equation 13: the head's velocity fed forward, the marker's image error fed back. */
static void follow(const struct senses *senses, struct wants *wants, double disparity)
{
    const struct config *config = senses->config;
    const double *head_velocity = wants->velocity + config_arm_joints(config);
    const double centre[SPACE_DIMENSIONS] = {0, 0, disparity};
    double x_velocity[SPACE_DIMENSIONS];

    control_approach(senses, wants, centre, config->task_follow_gain, x_velocity);
    for (int i = 0; i < HEAD_JOINTS; i++)
        x_velocity[i] += head_velocity[i];
    control_task_velocity(senses, wants, x_velocity);
}

static void turn_head(struct coordinate *coordinate, const struct senses *senses,
                      struct wants *wants)
{
    const struct config *config = senses->config;
    struct targets *targets = &coordinate->targets;
    int n_arm = config_arm_joints(config);

    targets_slide(config->period, config->head_smoothing, coordinate->head_goal, targets->setpoint,
                  HEAD_JOINTS);
    head_turn(config, senses->q + n_arm, targets->setpoint, wants->velocity + n_arm);
    /* Shaped here, since the arm is to follow what the head really does. */
    motion_shape(config, n_arm, HEAD_JOINTS, senses->q, senses->previous, wants->velocity);
}

static bool coordinate_step(struct behaviour *behaviour, const struct senses *senses,
                            struct wants *wants)
{
    struct coordinate *coordinate = behaviour_state(behaviour);
    struct targets *targets = &coordinate->targets;
    const double *target = NULL;

    switch (targets_step(targets, &behaviour->progress, senses, wants, &target)) {
    case TARGETS_PREPARE:
        memcpy(targets->setpoint, senses->q + config_arm_joints(senses->config),
               HEAD_JOINTS * sizeof(double));
        return true;
    case TARGETS_DONE:
        return false;
    case TARGETS_PRESENT:
        present(coordinate, senses, target);
        break;
    case TARGETS_PURSUE:
        break;
    }
    if (!sight_seen(senses->sight, senses->now)) {
        targets_refixate(targets, &behaviour->progress);
        return true;
    }
    turn_head(coordinate, senses, wants);
    follow(senses, wants, target[2]);
    if (senses->sight->new_frame && sight_centred(senses->sight))
        control_gather(senses, wants, 1);
    return true;
}

BEHAVIOUR_STATE_FITS(struct coordinate);

const struct behaviour_ops behaviour_coordinate = {
    .name = "coordinate",
    .kind = REACH_REQUEST_T_COORDINATE,
    .code = REACH_STATUS_T_COORDINATE,
    .state_size = sizeof(struct coordinate),
    .accepts = coordinate_accepts,
    .start = coordinate_start,
    .step = coordinate_step,
};
