#include "daemon/config/table.h"

#include "daemon/config/defaults.h"
#include "learner/parameters/rows.h"

#include <string.h>

/* What one tick can touch of the learner's memory. */
static const double most_bytes = 16e6;

#define ROW(name, type, field, unit, initial, minimum, maximum, help)                              \
    {                                                                                              \
        name, type, offsetof(struct config, field), unit, initial, minimum, maximum, help, NULL    \
    }
#define NUMBER(name, field, unit, initial, minimum, maximum, help)                                 \
    ROW(name, OPTION_NUMBER, field, unit, initial, minimum, maximum, help)
#define COUNT(name, field, initial, minimum, maximum, help)                                        \
    ROW(name, OPTION_INT, field, NULL, initial, minimum, maximum, help)
#define LIST(name, field, unit, initial, minimum, maximum, help)                                   \
    ROW(name, OPTION_LIST, field, unit, initial, minimum, maximum, help)
#define FLAG(name, field, initial, help) ROW(name, OPTION_BOOL, field, NULL, initial, 0, 0, help)
#define CHOICE(name, field, initial, words, help)                                                  \
    {                                                                                              \
        name, OPTION_CHOICE, offsetof(struct config, field), NULL, initial, 0, 0, help, words      \
    }

#define LEARNER_ROW(name, type, field, minimum, maximum, choices, help)                            \
    {                                                                                              \
        "learner." name, type, offsetof(struct config, learner.field), NULL, option_preset,        \
            minimum, maximum, help, choices                                                        \
    }

static const struct option_row table[] = {
    NUMBER("period", period, "s", "0.02", 0.001, 1, "period of the control loop"),

    LIST("arm.min", arm_min, "deg", NULL, -360, 360, "lower limit of each arm joint"),
    LIST("arm.max", arm_max, "deg", NULL, -360, 360, "upper limit of each arm joint"),
    LIST("head.min", head_min, "deg", "[]", -180, 180, "lower limits of head yaw, pitch"),
    LIST("head.max", head_max, "deg", "[]", -180, 180, "upper limits of head yaw, pitch"),

    NUMBER("eyes.pixels_per_radian", eyes_pixels_per_radian, "px", "0", 0, 1e5,
           "shift of the image when the head turns by 1 rad (eq. 11 and eq. 12)"),
    NUMBER("eyes.stale", eyes_stale, "s", "0.2", 0.01, 10,
           "age at which the last seen marker or measured end-effector counts as lost"),
    NUMBER(
        "eyes.doubt", eyes_doubt, NULL, "1", 0, 1000,
        "times the learner's noise that what is seen may jump, or move without the arm; 0 = any"),

    NUMBER("motion.arm_velocity", motion_arm_velocity, "deg/s", "40", 0.1, 360,
           "greatest velocity of an arm joint in motion; at most safety.arm_velocity"),
    NUMBER("motion.arm_acceleration", motion_arm_acceleration, "deg/s2", "200", 1, 1e4,
           "greatest acceleration of an arm joint in motion; at most safety.arm_acceleration"),
    NUMBER("motion.head_velocity", motion_head_velocity, "deg/s", "60", 0.1, 720,
           "greatest velocity of a head joint in motion; at most safety.head_velocity"),
    NUMBER("motion.head_acceleration", motion_head_acceleration, "deg/s2", "400", 1, 1e5,
           "greatest acceleration of a head joint in motion; at most safety.head_acceleration"),
    NUMBER("motion.margin", motion_margin, "deg", "0.5", 0, 20,
           "distance kept from every joint limit"),
    NUMBER("motion.slow_down", motion_slow_down, "1/s", "4", 0.1, 50,
           "greatest velocity per distance to a joint limit (less motion.margin)"),

    NUMBER("safety.arm_velocity", safety_arm_velocity, "deg/s", "60", 0.1, 720,
           "the safety gate lets no arm command exceed this velocity"),
    NUMBER("safety.arm_acceleration", safety_arm_acceleration, "deg/s2", "600", 1, 1e5,
           "the safety gate lets no arm command change faster than this"),
    NUMBER("safety.head_velocity", safety_head_velocity, "deg/s", "120", 0.1, 1440,
           "the safety gate lets no head command exceed this velocity"),
    NUMBER("safety.head_acceleration", safety_head_acceleration, "deg/s2", "1200", 1, 1e6,
           "the safety gate lets no head command change faster than this"),
    NUMBER("safety.state_hold", safety_state_hold, "s", "0.04", 0.001, 10,
           "age of the robot state above which the daemon holds the robot still"),
    NUMBER("safety.state_suspend", safety_state_suspend, "s", "0.1", 0.001, 60,
           "age of the robot state above which the behaviour is suspended; at least state_hold"),
    NUMBER("safety.reaction", safety_reaction, "s", "0.12", 0, 20,
           "loop standstill allowed for in braking before limits; at least loop_stall + period"),
    NUMBER("safety.latency", safety_latency, "s", "0.04", 0, 1,
           "delay of state and command, beyond a period, allowed for in braking before limits"),
    NUMBER("safety.loop_stall", safety_loop_stall, "s", "0.1", 0.01, 10,
           "standstill of the loop after which the watchdog brakes the arm; at least 3 periods"),
    NUMBER("safety.following", safety_following, "deg", "2", 0.01, 360,
           "motion that a joint may miss in 0.25 s, besides half of what was commanded"),
    NUMBER("safety.following_time", safety_following_time, "s", "10", 0.01, 3600,
           "time of motion for which a joint that did follow misses more, until it is a fault"),
    NUMBER("safety.jump", safety_jump, "deg", "5", 0.1, 360,
           "farther than its safety velocity allows, a joint that moved between two states jumped"),
    COUNT("safety.overruns_fault", safety_overruns_fault, "10", 1, 100000,
          "number of late ticks in a row at which the daemon enters the fault state"),

    NUMBER("head.gain", head_gain, "1/s", "6", 0.01, 50,
           "gains K_0 and K_1 of eq. 11: velocity of a head joint per radian of error"),
    NUMBER("head.smoothing", head_smoothing, "s", "0.3", 0, 10,
           "time constant with which the head's goal slides to a new target; 0 = it jumps"),
    NUMBER("head.search_velocity", head_search_velocity, "deg/s", "40", 0.1, 720,
           "speed of the head's search for a lost marker; at most motion.head_velocity"),
    NUMBER("head.search_dwell", head_search_dwell, "s", "0.15", 0, 10,
           "time that the head rests at each place where it searches"),

    NUMBER("fixation.tolerance", fixation_tolerance, "px", "2", 0.01, 100,
           "distance from the image centre within which the marker counts as fixated"),
    NUMBER("fixation.rest", fixation_rest, "px", "2.5", 0.01, 100,
           "movement over fixation.frames images up to which marker and joints count as at rest"),
    COUNT("fixation.frames", fixation_frames, "6", 1, 16,
          "number of images at rest in a row that fixation needs and one sample averages"),
    NUMBER("fixation.lost", fixation_lost, "s", "0.3", 0.01, 60,
           "time without a marker after which the head searches for it"),
    NUMBER("fixation.timeout", fixation_timeout, "s", "8", 0.1, 600,
           "time after which a configuration is given up if the marker could not be fixated"),

    LIST("babble.min", babble_min_given, "deg", "[]", -360, 360,
         "lower limits of random arm postures; both limits empty = arm's range less motion.margin"),
    LIST("babble.max", babble_max_given, "deg", "[]", -360, 360,
         "upper limits of random arm postures; both limits empty = arm's range less motion.margin"),
    NUMBER("babble.gain", babble_gain, "1/s", "6", 0.01, 50,
           "gain of the joint position control that moves the arm to a random posture"),
    NUMBER("babble.tolerance", babble_tolerance, "deg", option_preset, 0.001, 20,
           "distance from a random posture at which babbling counts it as reached"),
    NUMBER("babble.timeout", babble_timeout, "s", "10", 0.1, 600,
           "time for a move to a random posture, after which the robot fixates where the arm is"),

    COUNT("practice.samples", practice_samples, "0", 0, 10000,
          "number of samples babbled where targets were missed while learning; 0 = never"),
    COUNT("practice.missed", practice_missed, "2", 1, 4,
          "number of missed targets among the last 4 at which practice begins"),
    NUMBER("practice.tolerance", practice_tolerance, "px", "5", 0.01, 1000,
           "error above which a target counts as missed when its time is over (in an image)"),
    NUMBER("practice.tolerance_position", practice_tolerance_position, "m", "0.01", 1e-6, 10,
           "error above which a target counts as missed when its time is over (Cartesian space)"),
    NUMBER("practice.range", practice_range, "deg", "10", 0.1, 360,
           "how far practice moves each joint from the missed place, within babble.min and .max"),

    NUMBER("explore.noise", explore_noise, "deg/s", "30", 0, 360,
           "greatest strength of the random motion of a joint; it fades as predictions improve"),
    NUMBER("explore.speed", explore_speed, "1/s", "1", 0.01, 100,
           "greatest task velocity towards a goal in exploring, in scaled task units per second"),
    NUMBER("explore.widen", explore_widen, NULL, "0.3", 0, 100,
           "distance of goals in exploring beyond what was visited, in scaled task units"),
    NUMBER("explore.patience", explore_patience, "s", "1", 0.02, 600,
           "time without progress after which exploring gives up a goal"),
    NUMBER("explore.secondary_gain", explore_secondary_gain, "rad/s", "1", 0, 100,
           "gain K_s of eq. 4 in exploring: draws the null space to the goal's random posture"),
    NUMBER("explore.tolerance", explore_tolerance, "px", "20", 0.1, 1000,
           "distance from the image centre within which the marker gives a sample in exploring"),

    CHOICE("task.space", task_space, "visual", "visual|cartesian|fixed",
           "what is learned: visual = head angles that fixate a marker, cartesian = a position, "
           "fixed = a marker's place in the images of two cameras that nobody turns"),
    NUMBER("task.gain", task_gain, "1/s", "2.5", 0.01, 50, "K_m of eq. 4: gain on the task error"),
    NUMBER("task.smoothing", task_smoothing, "s", "0.15", 0, 10,
           "time constant with which reaching slides to a new target; 0 = it jumps"),
    NUMBER("task.follow_gain", task_follow_gain, "1/s", "3", 0, 50,
           "k_c of eq. 13: gain with which the arm follows the head in coordination"),
    NUMBER("task.secondary_gain", task_secondary_gain, "rad/s", option_preset, 0, 10,
           "gain K_s of eq. 4: draws the joints to the middle of their range in the null space"),
    NUMBER("task.singular_threshold", task_singular_threshold, NULL, option_preset, 1e-9, 1e3,
           "delta_T of eq. 9: where damping begins, in scaled task units per radian"),
    NUMBER("task.damping_max", task_damping_max, NULL, option_preset, 0, 1e3,
           "lambda_MAX of eq. 9: greatest damping, in scaled task units per radian"),
    NUMBER("task.scale_angle", task_scale_angle, "deg", "10", 1e-6, 360,
           "scaled task units: angles are divided by this before norms (eq. 8 and eq. 9)"),
    NUMBER("task.scale_disparity", task_scale_disparity, "px", "40", 1e-6, 1e4,
           "scaled task units: disparities are divided by this before norms (eq. 8 and eq. 9)"),
    NUMBER("task.scale_position", task_scale_position, "m", "0.2", 1e-6, 1e4,
           "scaled task units: positions are divided by this before norms (eq. 8 and eq. 9)"),

    CHOICE("learner.kind", learner_kind, "imle", "imle|lwpr",
           "learning algorithm: imle = mixture of experts, lwpr = local regression"),
    LEARNER_ROWS(LEARNER_ROW),
    NUMBER("learner.noise_angle", learner_noise_angle, "deg", "0.5", 1e-6, 90,
           "standard deviation of angles about an expert's prediction: square root of Psi_0"),
    NUMBER("learner.noise_disparity", learner_noise_disparity, "px", "3", 1e-6, 1000,
           "standard deviation of disparities about an expert's prediction: square root of Psi_0"),
    NUMBER("learner.noise_position", learner_noise_position, "m", "0.01", 1e-6, 100,
           "standard deviation of positions about an expert's prediction: square root of Psi_0"),
    NUMBER("learner.reach", learner_reach, "rad", "3.16", 1e-6, 100,
           "standard deviation of a new expert's joint angles: square root of sigma_0"),
    LIST("learner.reference", learner_reference, "deg", option_preset, -360, 360,
         "middle of the range of each arm joint, where the polynomials are centred"),
    NUMBER("learner.scale", learner_scale, "rad", "1.5", 1e-6, 100,
           "unit of the joint angles in the polynomials and in LWPR's metric"),
    LIST("learner.body.order", learner_body_order, NULL, "[]", 1, OPTION_MAX_LIST,
         "body: arm joints from the base to the tip, by number from 1; empty = as they come"),
    {"learner.body.start", OPTION_TEXT, offsetof(struct config, learner_body_start), NULL, "", 0, 0,
     "body: URDF file that the search begins with, where task.space is cartesian; empty = none",
     NULL},
    {"learner.body.tip", OPTION_TEXT, offsetof(struct config, learner_body_tip), NULL, "", 0, 0,
     "body: link of that file at which the arm ends; empty = the end of its longest chain", NULL},
    NUMBER("learner.lwpr.norm_angle", learner_lwpr_norm_angle, "deg", "1", 1e-6, 360,
           "LWPR: unit of head angles in the cost that adapts the metric"),
    NUMBER("learner.lwpr.norm_disparity", learner_lwpr_norm_disparity, "px", "1", 1e-6, 1e4,
           "LWPR: unit of disparities in the cost that adapts the metric"),
    NUMBER("learner.lwpr.norm_position", learner_lwpr_norm_position, "m", "0.01", 1e-9, 1e3,
           "LWPR: unit of Cartesian positions in the cost that adapts the metric"),
    COUNT("learner.queue", learner_queue, "256", 1, 65536,
          "most training samples that wait to be learned; further ones are dropped and counted"),
    COUNT("learner.quota", learner_quota, "4", 1, 1000,
          "waiting samples learned per tick in lockstep (real time: as many as there is time for)"),

    {"model.directory", OPTION_TEXT, offsetof(struct config, model_directory), NULL, "", 0, 0,
     "directory in which the model is kept and saved; empty = nothing is stored", NULL},
    FLAG("model.automatic", model_automatic, "true",
         "true = store what is learned at once and go on from it at the next start"),
    COUNT("model.snapshot", model_snapshot, "500", 1, 1000000,
          "samples in the journal after which a snapshot is made, if the budget allows"),
    NUMBER("model.snapshot_budget", model_snapshot_budget, "MB", "4000", 0, 1e9,
           "most that snapshots may write a day, in the mean; 0 = no bound"),
    COUNT("model.saved_most", model_saved_most, "100", 0, 1000000,
          "most models saved by number; one more, and the oldest is removed; 0 = no bound"),
    NUMBER("model.sync", model_sync, "s", "0.5", 0, 3600,
           "longest time that a learned sample waits until it is written to disk"),
    COUNT("model.keep", model_keep, "2", 1, 1000,
          "number of snapshots kept on disk; with 2 or more, a damaged one can be rebuilt"),
    OPTION_END,
};

const struct option_row *config_table(void)
{
    return table;
}

void config_preset(struct config *config)
{
    memset(config, 0, sizeof *config);
    config->learner = learner_config_default(4, SPACE_DIMENSIONS);
    config->learner.features = LEARNER_BODY;
    config->learner.clustering = LEARNER_CLUSTER_LEADER;
    config->learner.inherit = true;
    config->learner.most_bytes = most_bytes;
    config->learner.hyper_psi = config->learner.prior_psi = INFINITY;
    config->learner.gamma_floor = 0.05;
}

void config_print_options(FILE *out)
{
    enum { ROWS = sizeof table / sizeof table[0], HELP_SIZE = 320 };
    struct option_row rows[ROWS];
    struct config config;
    char help[ROWS][HELP_SIZE];

    config_preset(&config);
    memcpy(rows, table, sizeof rows);
    for (int i = 0; rows[i].name; i++) {
        const char *reason = config_default_reason(rows[i].name);
        if (!reason)
            continue;
        snprintf(help[i], HELP_SIZE, "%s; derived: %s", rows[i].help, reason);
        rows[i].help = help[i];
        rows[i].initial = "derived";
    }
    options_print(rows, &config, out);
}
