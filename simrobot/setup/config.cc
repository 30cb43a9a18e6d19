#include "simrobot/setup/config.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <deque>
#include <iterator>
#include <vector>

namespace sim
{
namespace
{

#define AT(field) offsetof(Config, field)
#define TOOL(field) offsetof(ToolConfig, field)

/* One row and a half a line; the formatter would make a column of it. */
/* clang-format off */
const struct option_row robot_rows[] = {
    {"robot.urdf", OPTION_TEXT, AT(urdf), nullptr, nullptr, 0, 0,
     "URDF file of the robot; a relative path starts at the folder of the configuration file",
     nullptr},
    {"robot.package_path", OPTION_TEXT, AT(package_path), nullptr, "", 0, 0,
     "folders of packages, for meshes whose file is package://NAME/...; separated by ':'", nullptr},
    {"robot.arm_joints", OPTION_NAMES, AT(arm_joints), nullptr, nullptr, 0, 0,
     "names of the arm's joints in the order of the messages: [a, b], or a b where no name has a "
     "blank", nullptr},
    {"robot.head_joints", OPTION_NAMES, AT(head_joints), nullptr, "", 0, 0,
     "names of the head's joints: yaw (positive to the left), then pitch (positive down); empty = "
     "no head, or eyes that do not turn", nullptr},
    {"robot.hand_link", OPTION_TEXT, AT(hand_link), nullptr, nullptr, 0, 0,
     "link at whose origin the ball sits and the tools begin", nullptr},
    {"robot.left_eye", OPTION_TEXT, AT(left_eye), nullptr, "", 0, 0,
     "link of the left eye: x along the optical axis, z up; empty = no eyes", nullptr},
    {"robot.right_eye", OPTION_TEXT, AT(right_eye), nullptr, "", 0, 0,
     "link of the right eye: x along the optical axis, z up; empty = no eyes", nullptr},
    {"robot.start", OPTION_LIST, AT(start), "deg", "[]", -36000, 36000,
     "joint angles at the start and after a reset: the arm's, then the head's; a joint that slides "
     "in m; empty = all 0, or the middle of a range without 0",
     nullptr},
    {"robot.hard_stops", OPTION_BOOL, AT(hard_stops), nullptr, "true", 0, 0,
     "true = mechanical stops at the URDF's limits; false = joints can pass their limits, so that "
     "an over-run can be seen", nullptr},
    {"robot.collisions", OPTION_BOOL, AT(collisions), nullptr, "false", 0, 0,
     "true = the URDF's <collision> shapes and the tool stop each other; false = they pass "
     "through each other", nullptr},
    {"robot.repair_inertia", OPTION_BOOL, AT(repair_inertia), nullptr, "false", 0, 0,
     "true = a link that moves without a mass, or with an inertia that no body has, takes that of a "
     "ball of water; false = it is refused", nullptr},
    {"motor.arm_acceleration", OPTION_NUMBER, AT(arm_acceleration), "deg/s2", "600", 10, 100000,
     "greatest acceleration that the motor drivers of the arm allow", nullptr},
    {"motor.head_acceleration", OPTION_NUMBER, AT(head_acceleration), "deg/s2", "1500", 10, 100000,
     "greatest acceleration that the motor drivers of the head allow", nullptr},
    {"motor.command_timeout", OPTION_NUMBER, AT(command_timeout), "s", "0.1", 0.02, 10,
     "age at which a command is dropped and the motors hold, with the real-time clock", nullptr},
    {"encoder.distribution", OPTION_CHOICE, AT(encoder_noise_kind), nullptr, "gaussian", 0, 0,
     "distribution of the errors of encoder readings", "uniform|gaussian"},
    {"encoder.noise", OPTION_NUMBER, AT(encoder_noise), "deg", "0.01", 0, 5,
     "error of a position reading: standard deviation (gaussian) or half width (uniform)", nullptr},
    {"encoder.velocity_noise", OPTION_NUMBER, AT(encoder_velocity_noise), "deg/s", "0.1", 0, 50,
     "error of a velocity reading: standard deviation (gaussian) or half width (uniform)", nullptr},
    {"effector.published", OPTION_BOOL, AT(effector_published), nullptr, "false", 0, 0,
     "true = END_EFFECTOR is sent with every state: the ball's centre in the frame of the URDF's "
     "base", nullptr},
    {"effector.noise", OPTION_NUMBER, AT(effector_noise), "m", "0", 0, 0.1,
     "standard deviation of each coordinate in END_EFFECTOR", nullptr},
    {"ball.radius", OPTION_NUMBER, AT(ball_radius), "m", "0.02", 0.003, 0.2,
     "radius of the ball that is the marker", nullptr},
    {"ball.mass", OPTION_NUMBER, AT(ball_mass), "kg", "0.01", 0.001, 1,
     "mass of the ball that is the marker", nullptr},
    {"ball.colour", OPTION_LIST, AT(ball_colour), nullptr, "[0.10, 0.75, 0.16]", 0, 1,
     "colour of the ball: red, green, blue", nullptr},
    {"eyes.width", OPTION_INT, AT(width), "px", "640", 16, 4096,
     "width of each eye's image", nullptr},
    {"eyes.height", OPTION_INT, AT(height), "px", "480", 16, 4096,
     "height of each eye's image", nullptr},
    {"eyes.focal_length", OPTION_NUMBER, AT(focal_length), "px", "1200", 10, 20000,
     "focal length of both eyes; the optical axis meets the image's centre", nullptr},
    {"eyes.latency", OPTION_NUMBER, AT(latency), "s", "0.033", 0, 1,
     "time from the exposure of an image until it is available, as with a USB camera", nullptr},
    {"eyes.noise", OPTION_NUMBER, AT(sensor_noise), "grey levels", "2.0", 0, 50,
     "standard deviation of the image sensors' noise, of 255 grey levels", nullptr},
    {"eyes.tremble", OPTION_NUMBER, AT(eye_tremble), "deg", "0.015", 0, 1,
     "standard deviation of the random turn of the eyes' mounts from image to image", nullptr},
    {"eyes.creep", OPTION_NUMBER, AT(eye_creep), "deg", "0.025", 0, 2,
     "extent of the slow turn of the eyes' mounts, which warm and cool", nullptr},
    {"eyes.creep_period", OPTION_NUMBER, AT(eye_creep_period), "s", "60", 1, 100000,
     "period of the slowest part of eyes.creep", nullptr},
    {"images.format", OPTION_CHOICE, AT(image_format), nullptr, "jpeg", 0, 0,
     "format of the images on the bus; rgb needs net.core.rmem_max above 4 MB", "jpeg|rgb"},
    {"images.quality", OPTION_INT, AT(jpeg_quality), nullptr, "85", 1, 100,
     "quality of the images in format jpeg", nullptr},
    {"light.drift", OPTION_NUMBER, AT(light_drift), nullptr, "1.0", 0, 3,
     "how far direction, strength and colour of the light wander; 0 = constant light, as in a "
     "studio", nullptr},
    {"light.period", OPTION_NUMBER, AT(light_period), "s", "40", 1, 100000,
     "period of the slowest part of light.drift", nullptr},
    {"light.flicker", OPTION_NUMBER, AT(light_flicker), nullptr, "0.02", 0, 1,
     "share by which the brightness of the lamps changes from image to image", nullptr},
    {"physics.step", OPTION_INT, AT(physics_step), "ms", "1", 1, 20,
     "step of the integration, a divisor of the 20 ms period; must be 1 for robots with eyes",
     nullptr},
    {"lockstep.resend", OPTION_NUMBER, AT(lockstep_resend), "s", "0.5", 0.01, 60,
     "time on the wall clock after which an unanswered state is sent again, in lockstep", nullptr},
    {"lockstep.timeout", OPTION_NUMBER, AT(lockstep_timeout), "s", "10", 0.1, 3600,
     "time on the wall clock after which a warning says that reachd does not answer, in lockstep",
     nullptr},
};

/* For each tool, with "tool1." .. before the name and the tool's offset added. */
const struct option_row tool_rows[] = {
    {"kind", OPTION_CHOICE, TOOL(kind), nullptr, "none", 0, 0,
     "kind of tool that the experimenter attaches under this number", "none|tube|stick"},
    {"length", OPTION_NUMBER, TOOL(length), "m", "0.35", 0.05, 1,
     "distance from the hand's frame to the centre of the ball on the tool's tip", nullptr},
    {"radius", OPTION_NUMBER, TOOL(radius), "m", "0.006", 0.001, 0.05,
     "half the thickness of the tool", nullptr},
    {"mass", OPTION_NUMBER, TOOL(mass), "kg", "0.043", 0.005, 2,
     "mass of the tool without the ball", nullptr},
    {"direction", OPTION_LIST, TOOL(direction), nullptr, "[0, 1, 0]", -1, 1,
     "direction in which the tool points, in the frame of robot.hand_link", nullptr},
    {"foot", OPTION_NUMBER, TOOL(foot), "m", "0", 0, 1,
     "stick: length of a second arm at its end, which makes it an L; 0 = straight", nullptr},
    {"foot_direction", OPTION_LIST, TOOL(foot_direction), nullptr, "[0, 0, 1]", -1, 1,
     "stick: direction of the second arm, in the frame of robot.hand_link", nullptr},
    {"rigidity", OPTION_NUMBER, TOOL(rigidity), "N m2", "0.08", 0.005, 100,
     "tube: bending stiffness E I, which sets droop and frequency", nullptr},
    {"damping", OPTION_NUMBER, TOOL(damping), "s", "0.03", 0, 1,
     "tube: ratio of damping to stiffness in bending", nullptr},
    {"colour", OPTION_LIST, TOOL(colour), nullptr, "[0.16, 0.15, 0.17]", 0, 1,
     "colour of the tool: red, green, blue", nullptr},
};
/* clang-format on */

/* All rows, made once: the robot's, then those of each tool, then the table's end. */
const struct option_row *table()
{
    static std::deque<std::string> names;
    static std::vector<struct option_row> rows;

    if (!rows.empty())
        return rows.data();
    rows.assign(std::begin(robot_rows), std::end(robot_rows));
    for (size_t tool = 0; tool < max_tools; tool++)
        for (struct option_row row : tool_rows) {
            names.push_back("tool" + std::to_string(tool + 1) + "." + row.name);
            row.name = names.back().c_str();
            row.offset += offsetof(Config, tools) + tool * sizeof(ToolConfig);
            rows.push_back(row);
        }
    rows.push_back({});
    return rows.data();
}

bool has_three(const struct option_list &list, const std::string &name, std::string *error)
{
    if (list.n == 3)
        return true;
    *error = name + ": three numbers are wanted, not " + std::to_string(list.n);
    return false;
}

bool is_direction(const struct option_list &list, const std::string &name, std::string *error)
{
    if (!has_three(list, name, error))
        return false;
    if (std::hypot(list.value[0], list.value[1], list.value[2]) >= 1e-3)
        return true;
    *error = name + ": must not be zero";
    return false;
}

/* What one row cannot know of another. */
bool check(const Config &config, std::string *error)
{
    if (!has_three(config.ball_colour, "ball.colour", error))
        return false;
    for (int i = 0; i < max_tools; i++) {
        const ToolConfig &tool = config.tools[i];
        std::string name = "tool" + std::to_string(i + 1);
        if (!is_direction(tool.direction, name + ".direction", error) ||
            !is_direction(tool.foot_direction, name + ".foot_direction", error) ||
            !has_three(tool.colour, name + ".colour", error))
            return false;
    }
    if (20 % config.physics_step != 0 || (config.physics_step != 1 && config.left_eye[0])) {
        *error = "physics.step: a divisor of 20 ms is wanted, and 1 ms where there are eyes";
        return false;
    }
    return true;
}

/* A URDF lies beside its YAML file, wherever the program is started. */
bool resolve_urdf(Config *config, const char *path, std::string *error)
{
    const char *slash = path ? strrchr(path, '/') : nullptr;

    if (config->urdf[0] == '/' || !slash)
        return true;
    std::string whole = std::string(path, static_cast<size_t>(slash - path) + 1) + config->urdf;
    if (whole.size() >= sizeof config->urdf) {
        *error = "robot.urdf: path is too long";
        return false;
    }
    memcpy(config->urdf, whole.c_str(), whole.size() + 1);
    return true;
}

} // namespace

bool config_load(Config *config, const char *path, const char *const *overrides, int n_overrides,
                 std::string *error)
{
    char line[1024] = "";

    if (options_load(table(), config, &path, 1, overrides, n_overrides, line, sizeof line)) {
        *error = line;
        return false;
    }
    if (!check(*config, error)) {
        *error = std::string(path ? path : "options") + ": " + *error;
        return false;
    }
    return resolve_urdf(config, path, error);
}

void config_print_options(FILE *out)
{
    options_print(table(), nullptr, out);
}

} // namespace sim
