#include "daemon/config/table.h"

#include "learner/parameter_rows.h"

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
    LIST("head.min", head_min, "deg", "[]", -180, 180, "lower limit of head yaw, pitch"),
    LIST("head.max", head_max, "deg", "[]", -180, 180, "upper limit of head yaw, pitch"),

    NUMBER("eyes.pixels_per_radian", pixels_per_radian, "px", "0", 0, 1e5,
           "shift of the image when the head turns: relation of eq. 11 and eq. 12"),
    NUMBER("eyes.stale", eyes_stale, "s", "0.2", 0.01, 10,
           "age of the last seen marker (or measured end-effector) at which it counts as lost"),

    NUMBER("motion.arm_velocity", arm_velocity, "deg/s", "40", 0.1, 360, "greatest wanted"),
    NUMBER("motion.arm_acceleration", arm_acceleration, "deg/s2", "200", 1, 1e4, "greatest wanted"),
    NUMBER("motion.head_velocity", head_velocity, "deg/s", "60", 0.1, 720, "greatest wanted"),
    NUMBER("motion.head_acceleration", head_acceleration, "deg/s2", "400", 1, 1e5,
           "greatest wanted"),
    NUMBER("motion.margin", margin, "deg", "0.5", 0, 20, "distance kept from the joint limits"),
    NUMBER("motion.slow_down", slow_down, "1/s", "4", 0.1, 50,
           "greatest velocity per distance to a joint limit"),

    NUMBER("safety.arm_velocity", safety_arm_velocity, "deg/s", "60", 0.1, 720,
           "no arm command exceeds this"),
    NUMBER("safety.arm_acceleration", safety_arm_acceleration, "deg/s2", "600", 1, 1e5,
           "no arm command changes faster than this"),
    NUMBER("safety.head_velocity", safety_head_velocity, "deg/s", "120", 0.1, 1440,
           "no head command exceeds this"),
    NUMBER("safety.head_acceleration", safety_head_acceleration, "deg/s2", "1200", 1, 1e6,
           "no head command changes faster than this"),
    NUMBER("safety.state_hold", state_hold, "s", "0.04", 0.001, 10,
           "age of the robot state at which the robot is held still"),
    NUMBER("safety.state_suspend", state_suspend, "s", "0.1", 0.001, 60,
           "age of the robot state at which the behaviour is suspended"),
    NUMBER("safety.reaction", reaction, "s", "0.12", 0, 2,
           "standstill of the loop that braking before a joint limit reckons with"),
    NUMBER("safety.latency", latency, "s", "0.04", 0, 1,
           "delays of state and command, beyond a period, that it reckons with"),
    NUMBER("safety.loop_stall", loop_stall, "s", "0.1", 0.01, 10,
           "standstill of the loop after which the watchdog stops the arm"),
    COUNT("safety.overruns_fault", overruns_fault, "10", 1, 100000,
          "late ticks in a row that are a fault"),

    NUMBER("head.gain", head_gain, "1/s", "6", 0.01, 50, "K_0 and K_1 of eq. 11, per radian"),
    NUMBER("head.smoothing", head_smoothing, "s", "0.3", 0, 10,
           "time constant with which it goes over to a target that the arm follows, 0 = at once"),
    NUMBER("head.search_velocity", search_velocity, "deg/s", "40", 0.1, 720,
           "speed of the search for a marker that is out of view"),
    NUMBER("head.search_dwell", search_dwell, "s", "0.15", 0, 10,
           "rest at each place that the search looks at"),

    NUMBER("fixation.tolerance", fixation_tolerance, "px", "2", 0.01, 100,
           "distance from the image centre at which the marker counts as fixated"),
    NUMBER("fixation.rest", fixation_rest, "px", "2.5", 0.01, 100,
           "spread over the frames up to which marker and head count as at rest"),
    COUNT("fixation.frames", fixation_frames, "6", 1, 16, "frames that one sample averages"),
    NUMBER("fixation.lost", fixation_lost, "s", "0.3", 0.01, 60,
           "time without a marker after which it is searched"),
    NUMBER("fixation.timeout", fixation_timeout, "s", "8", 0.1, 600,
           "time for fixation after which a configuration is given up"),

    LIST("babble.min", babble_min_given, "deg", "[]", -360, 360,
         "least random reference; without it the arm's range less motion.margin"),
    LIST("babble.max", babble_max_given, "deg", "[]", -360, 360, "greatest, likewise"),
    NUMBER("babble.gain", babble_gain, "1/s", "4", 0.01, 50, "of the joint position control"),
    NUMBER("babble.tolerance", babble_tolerance, "deg", "0.3", 0.001, 20,
           "distance at which a reference counts as reached"),
    NUMBER("babble.timeout", babble_timeout, "s", "10", 0.1, 600,
           "time for a move after which the arm fixates where it is"),

    COUNT("practice.samples", practice_samples, "0", 0, 10000,
          "babbled about where targets were missed, while learning; 0 = never"),
    COUNT("practice.missed", practice_missed, "2", 1, 4, "of the last 4 targets, after which"),
    NUMBER("practice.tolerance", practice_tolerance, "px", "5", 0.01, 1000,
           "distance at the end of its time at which a target counts as missed"),
    NUMBER("practice.tolerance_position", practice_tolerance_position, "m", "0.01", 1e-6, 10,
           "the same in a Cartesian task space"),
    NUMBER("practice.range", practice_range, "deg", "10", 0.1, 360,
           "how far from where it is a joint babbles then, within babble.min and babble.max"),

    NUMBER("explore.noise", explore_noise, "deg/s", "30", 0, 360,
           "random motion of a joint where the model knows nothing"),
    NUMBER("explore.speed", explore_speed, "1/s", "1", 0.01, 100,
           "greatest task velocity towards a goal, in scaled rows"),
    NUMBER("explore.widen", explore_widen, NULL, "0.3", 0, 100,
           "how far beyond what was visited goals lie, in scaled rows"),
    NUMBER("explore.patience", explore_patience, "s", "1", 0.02, 600,
           "time without progress after which a goal is given up"),
    NUMBER("explore.secondary_gain", explore_secondary_gain, "rad/s", "1", 0, 100,
           "K_s of eq. 4 towards a goal's random posture"),
    NUMBER("explore.tolerance", explore_tolerance, "px", "20", 0.1, 1000,
           "distance from the image centre at which a sample is good enough"),

    CHOICE("task.space", task_space, "visual", "visual|cartesian",
           "what is learned: the head that fixates a marker, or a measured position"),
    NUMBER("task.gain", task_gain, "1/s", "2.5", 0.01, 50, "K_m of eq. 4"),
    NUMBER("task.smoothing", task_smoothing, "s", "0.15", 0, 10,
           "time constant with which reaching goes over to a new target, 0 = at once"),
    NUMBER("task.follow_gain", follow_gain, "1/s", "3", 0, 50, "k_c of eq. 13"),
    NUMBER("task.secondary_gain", secondary_gain, "rad/s", "0.05", 0, 10,
           "K_s of eq. 4: joints towards the middle of their range, in the null space"),
    NUMBER("task.singular_threshold", singular_threshold, NULL, "0.05", 1e-9, 1e3,
           "delta_T of eq. 9, in scaled task units per radian"),
    NUMBER("task.damping_max", damping_max, NULL, "0.05", 0, 1e3,
           "lambda_MAX of eq. 9, in scaled task units per radian"),
    NUMBER("task.scale_angle", scale_angle, "deg", "10", 1e-6, 360,
           "task rows of angles are divided by this before norms, eq. 8 and eq. 9"),
    NUMBER("task.scale_disparity", scale_disparity, "px", "40", 1e-6, 1e4,
           "the task row of disparity is divided by this, likewise"),
    NUMBER("task.scale_position", scale_position, "m", "0.2", 1e-6, 1e4,
           "the rows of a Cartesian task space are divided by this, likewise"),

    CHOICE("learner.kind", learner_kind, "imle", "imle|null|lwpr", "learning algorithm"),
    LEARNER_ROWS(LEARNER_ROW),
    NUMBER("learner.noise_angle", learner_noise_angle, "deg", "1", 1e-6, 90,
           "standard deviation of the angles about an expert: square root of Psi_0"),
    NUMBER("learner.noise_disparity", learner_noise_disparity, "px", "3", 1e-6, 1000,
           "the same for the disparity"),
    NUMBER("learner.noise_position", learner_noise_position, "m", "0.01", 1e-6, 100,
           "the same for the rows of a Cartesian task space"),
    NUMBER("learner.reach", learner_reach, "rad", "0.5", 1e-6, 100,
           "standard deviation of an expert's inputs: square root of sigma_0"),
    LIST("learner.reference", learner_reference, "deg", NULL, -360, 360,
         "middle of the joints' range, where polynomials are centred"),
    NUMBER("learner.scale", learner_scale, "rad", "1", 1e-6, 100, "unit of the polynomials"),
    NUMBER("learner.lwpr.norm_angle", lwpr_norm_angle, "deg", "1", 1e-6, 360,
           "LWPR: unit of the angles in the metric's cost"),
    NUMBER("learner.lwpr.norm_disparity", lwpr_norm_disparity, "px", "1", 1e-6, 1e4,
           "LWPR: unit of the disparity, likewise"),
    NUMBER("learner.lwpr.norm_position", lwpr_norm_position, "m", "0.01", 1e-9, 1e3,
           "LWPR: unit of a Cartesian position, likewise"),
    COUNT("learner.queue", learner_queue, "256", 1, 65536, "training samples that may wait"),
    COUNT("learner.quota", learner_quota, "4", 1, 1000, "samples learned in one tick of lockstep"),

    {"model.directory", OPTION_TEXT, offsetof(struct config, model_directory), NULL, "", 0, 0,
     "where the model is kept and saved; empty: neither", NULL},
    FLAG("model.automatic", model_automatic, "true",
         "keep what is learned as it is learned, and go on from it at the next start"),
    COUNT("model.snapshot", model_snapshot, "500", 1, 1000000,
          "samples in the journal after which a snapshot is made: bounds the time of a start"),
    NUMBER("model.sync", model_sync, "s", "0.5", 0, 3600,
           "longest time that a learned sample waits to be stored"),
    COUNT("model.keep", model_keep, "2", 1, 1000,
          "snapshots on disk; with two or more, one that is damaged can be rebuilt"),
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
    config->learner.features = LEARNER_POLYNOMIAL;
    config->learner.clustering = LEARNER_CLUSTER_LEADER;
    config->learner.inherit = true;
    config->learner.most_bytes = most_bytes;
}

void config_print_options(FILE *out)
{
    struct config config;

    config_preset(&config);
    options_print(table, &config, out);
}
