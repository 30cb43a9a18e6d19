/* The simulator's options: what the URDF of a robot lacks (eyes, ball, tools, noise, light) and how
 * the clock runs. Angles are radians here; the YAML file is in degrees. */
#ifndef SIMROBOT_SETUP_CONFIG_H
#define SIMROBOT_SETUP_CONFIG_H

#include <string>

#include "common/options/options.h"

namespace sim
{

inline constexpr int max_joints = 16;
inline constexpr int max_tools = 3;

enum class ToolKind { none, tube, stick };
enum class NoiseKind { uniform, gaussian };
enum class ImageFormat { jpeg, rgb };

/* One tool that the experimenter may put into the hand. */
struct ToolConfig {
    int kind;                     /* ToolKind */
    double length;                /* m, from the hand's frame to the ball's centre */
    double radius;                /* m */
    double mass;                  /* kg, without the ball */
    struct option_list direction; /* in the hand's frame; need not be of length 1 */
    double foot;                  /* stick: length of a second arm at its end, m; 0 = straight */
    struct option_list foot_direction; /* in the hand's frame */
    double rigidity;                   /* tube: bending stiffness E I, N m^2 */
    double damping;                    /* tube: bending loss as a time, c = damping * k, s */
    struct option_list colour;         /* red, green, blue, 0 .. 1 */
};

struct Config {
    char urdf[OPTION_MAX_TEXT];
    char package_path[OPTION_MAX_TEXT];
    char arm_joints[OPTION_MAX_NAMES]; /* a line each */
    char head_joints[OPTION_MAX_NAMES];
    char hand_link[OPTION_MAX_TEXT];
    char left_eye[OPTION_MAX_TEXT];
    char right_eye[OPTION_MAX_TEXT];
    struct option_list start;
    bool hard_stops;
    bool collisions;
    bool repair_inertia;

    double arm_acceleration;
    double head_acceleration;
    double command_timeout;

    int encoder_noise_kind; /* NoiseKind */
    double encoder_noise;
    double encoder_velocity_noise;

    bool effector_published;
    double effector_noise;

    double ball_radius;
    double ball_mass;
    struct option_list ball_colour;
    struct ToolConfig tools[max_tools];

    int width;
    int height;
    double focal_length;
    double latency;
    int image_format; /* ImageFormat */
    int jpeg_quality;
    double sensor_noise;
    double eye_tremble;
    double eye_creep;
    double eye_creep_period;
    double light_drift;
    double light_period;
    double light_flicker;

    int physics_step; /* ms */

    double lockstep_resend;
    double lockstep_timeout;
};

/* Reads the YAML file `path` and the overrides "name=value", and checks what the table cannot.
 *   returns false with one line in `error`. */
bool config_load(Config *config, const char *path, const char *const *overrides, int n_overrides,
                 std::string *error);

/* Prints every option with unit, default, range and meaning. */
void config_print_options(FILE *out);

} // namespace sim
#endif
