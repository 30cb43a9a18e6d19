/* The daemon's configuration: one struct, which load.h fills from one row per option (table.c). */
#ifndef REACH_DAEMON_CONFIG_CONFIG_H
#define REACH_DAEMON_CONFIG_CONFIG_H

#include "common/options/options.h"
#include "daemon/config/space.h"
#include "learner/learner.h"

#include <stdint.h>

/* Angles in radians, times in seconds, image distances in pixels. */
struct config {
    double period; /* of the loop, s */

    struct option_list arm_min, arm_max, head_min, head_max; /* joint range, rad */

    double eyes_pixels_per_radian; /* image shift for a turn of the head */
    double eyes_stale;             /* age at which a marker no longer counts as seen, s */
    double eyes_doubt;             /* motion of the marker that is no lie; 0 = none is */

    double motion_arm_velocity, motion_arm_acceleration;   /* of wanted motion */
    double motion_head_velocity, motion_head_acceleration; /* of wanted motion */
    double motion_margin;                                  /* kept from the joint limits, rad */
    double motion_slow_down; /* greatest velocity per distance to a limit, 1/s */

    double safety_arm_velocity, safety_arm_acceleration;
    double safety_head_velocity, safety_head_acceleration;
    double safety_state_hold, safety_state_suspend; /* ages of the robot state, s */
    double safety_reaction, safety_latency; /* that braking before a limit reckons with, s */
    double safety_loop_stall;               /* standstill of the loop, s */
    double safety_following_time;           /* in which it may miss that, s */
    double safety_following;                /* motion that a joint may miss, rad */
    double safety_jump;        /* of a joint between two states, beyond what it can move, rad */
    int safety_overruns_fault; /* late ticks in a row that are a fault */

    double head_gain;      /* eq. 11, 1/s */
    double head_smoothing; /* of the way to a target that the arm follows, s */
    double head_search_velocity, head_search_dwell;

    double fixation_tolerance, fixation_rest; /* px */
    int fixation_frames;
    double fixation_lost, fixation_timeout; /* s */

    struct option_list babble_min_given, babble_max_given; /* rad, may be empty */
    double babble_gain, babble_tolerance, babble_timeout;

    int practice_samples, practice_missed;
    double practice_tolerance, practice_tolerance_position, practice_range;
    double explore_noise, explore_speed, explore_widen, explore_patience;
    double explore_secondary_gain, explore_tolerance;

    int task_space;             /* enum space_kind */
    double task_gain;           /* K_m of eq. 4, 1/s */
    double task_smoothing;      /* of the set-point of reaching, s */
    double task_follow_gain;    /* k_c of eq. 13, 1/s */
    double task_secondary_gain; /* K_s of eq. 4, rad/s for a gradient of 1 */
    double task_singular_threshold,
        task_damping_max; /* delta_T, lambda_MAX of eq. 9, scaled task rows */
    double task_scale_angle, task_scale_disparity,
        task_scale_position; /* what counts as one in a task row */

    struct learner_config learner; /* its scalar rows; config_learner() adds the rest: */
    int learner_kind;
    double learner_noise_angle, learner_noise_disparity, learner_noise_position; /* sqrt(Psi0) */
    double learner_reach;                 /* sqrt(sigma0), rad */
    struct option_list learner_reference; /* rad */
    double learner_scale;                 /* rad */
    char learner_body_start[OPTION_MAX_TEXT];
    char learner_body_tip[OPTION_MAX_TEXT];
    struct option_list learner_body_order; /* from 1, base to tip; may be empty */
    double learner_lwpr_norm_angle, learner_lwpr_norm_disparity,
        learner_lwpr_norm_position; /* rad, px, m */
    int learner_queue, learner_quota;

    char model_directory[OPTION_MAX_TEXT];
    bool model_automatic;
    int model_snapshot, model_keep, model_saved_most;
    double model_snapshot_budget; /* MB a day */
    double model_sync;            /* s */

    /* What follows from the rows above (derived.c). */
    struct option_list babble_min, babble_max; /* rad */
    struct space space; /* the rows that depend on task.space, as it wants them */
    uint32_t checksum;  /* of all rows as text (config/text.h) */
};

/* Numbers of joints. The arm's come first in states and commands. */
static inline int config_arm_joints(const struct config *config)
{
    return config->arm_min.n;
}

static inline int config_head_joints(const struct config *config)
{
    return config->head_min.n;
}

static inline int config_joints(const struct config *config)
{
    return config_arm_joints(config) + config_head_joints(config);
}

/* Limits of joint i of the command, arm first: range (rad), velocity, acceleration (rad/s, rad/s2)
 * of wanted motion, and the hard ones of the safety gate. */
struct joint_limits {
    double min, max;
    double velocity, acceleration;
    double safety_velocity, safety_acceleration;
};
struct joint_limits config_joint_limits(const struct config *config, int joint);

/* The learner's parameters, in its own terms. */
struct learner_config config_learner(const struct config *config);

#endif
