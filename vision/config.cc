#include "vision/config.h"

#include "common/options/options.h"

#define AT(field) offsetof(vision_config, field)
#define NUMBER(name, field, unit, initial, low, high, help)                                        \
    {                                                                                              \
        name, OPTION_NUMBER, AT(field), unit, initial, low, high, help, nullptr                    \
    }
#define WHOLE(name, field, unit, initial, low, high, help)                                         \
    {                                                                                              \
        name, OPTION_INT, AT(field), unit, initial, low, high, help, nullptr                       \
    }

/* The rows of one eye. */
#define EYE_ROWS(eye)                                                                              \
    NUMBER(#eye ".focal", eye##_focal, "px", "1200", 50, 20000,                                    \
           "focal length of the " #eye " camera"),                                                 \
        NUMBER(#eye ".centre_u", eye##_centre_u, "px", "0", -1000, 1000,                           \
               "distance of the " #eye " camera's optical axis to the right of the image centre"), \
        NUMBER(#eye ".centre_v", eye##_centre_v, "px", "0", -1000, 1000,                           \
               "distance of the " #eye " camera's optical axis below the image centre"),           \
        NUMBER(#eye ".k1", eye##_k1, nullptr, "0", -2, 2,                                          \
               "radial distortion of the " #eye                                                    \
               " camera: factor of the squared slope of a line of sight"),                         \
        NUMBER(#eye ".k2", eye##_k2, nullptr, "0", -2, 2,                                          \
               "radial distortion of the " #eye                                                    \
               " camera: factor of the fourth power of the slope of a line of sight"),             \
        NUMBER(#eye ".k3", eye##_k3, nullptr, "0", -2, 2,                                          \
               "radial distortion of the " #eye                                                    \
               " camera: factor of the sixth power of the slope of a line of sight"),              \
        NUMBER(#eye ".p1", eye##_p1, nullptr, "0", -1, 1,                                          \
               "tangential distortion of the " #eye " camera, as OpenCV's p1"),                    \
        NUMBER(#eye ".p2", eye##_p2, nullptr, "0", -1, 1,                                          \
               "tangential distortion of the " #eye " camera, as OpenCV's p2"),                    \
        NUMBER(#eye ".aspect", eye##_aspect, nullptr, "1", 0.5, 2,                                 \
               "OpenCV's fy / fx of the " #eye " camera: 1 for square pixels"),                    \
        NUMBER(#eye ".yaw", eye##_yaw, "deg", "0", -45, 45,                                        \
               "turn of the " #eye " camera to the right, besides half of eyes.vergence"),         \
        NUMBER(#eye ".pitch", eye##_pitch, "deg", "0", -45, 45,                                    \
               "turn of the " #eye " camera downwards"),                                           \
        NUMBER(#eye ".roll", eye##_roll, "deg", "0", -45, 45,                                      \
               "turn of the " #eye " camera about its optical axis, clockwise as it looks")

/* px: how wide the picture is that tolerances and windows are written for; they grow with it. */
static const double usual_width = 640;

static const struct option_row table[] = {
    WHOLE("camera.width", width, "px", "640", 32, 4096, "width of both cameras' pictures"),
    WHOLE("camera.height", height, "px", "480", 32, 4096, "height of both cameras' pictures"),
    NUMBER("camera.rate", camera_rate, "1/s", "30", 0, 1000,
           "pictures per second that are asked of cameras (--cameras); 0 = what they have"),
    EYE_ROWS(left),
    EYE_ROWS(right),
    NUMBER("eyes.vergence", vergence, "deg", "10", -60, 60,
           "angle by which the optical axes of the two eyes turn towards each other"),
    NUMBER("eyes.baseline", baseline, "m", "0.09", 0.001, 2, "distance between the two eyes"),
    NUMBER("eyes.most_apart", most_apart, "s", "0.02", 0, 1,
           "greatest difference between the two pictures' own time stamps, where they have some; "
           "pairs further apart are unusable; 0 = not checked"),
    {"marker.dictionary", OPTION_CHOICE, AT(tag_dictionary), nullptr, "none", 0, 0,
     "a printed tag of this dictionary of ArUco's or AprilTag's is the marker, and no ball; none = "
     "the marker is a ball",
     TAG_DICTIONARIES},
    WHOLE("marker.id", tag_id, nullptr, "0", 0, 2400, "number of the tag in its dictionary"),
    NUMBER("marker.size", tag_size, "m", "0", 0, 1,
           "side of the tag's black square; a tag of another size is refused; 0 = not known, not "
           "checked"),
    NUMBER("ball.hue", hue, "deg", "120", 0, 360,
           "middle of the ball's hue: 0 = red, 120 = green, 240 = blue"),
    NUMBER("ball.hue_tolerance", hue_tolerance, "deg", "30", 1, 180,
           "greatest difference between a pixel's hue and ball.hue"),
    NUMBER("ball.saturation_min", saturation_min, nullptr, "0.4", 0, 1,
           "least saturation of the ball's pixels; paler ones do not belong to it"),
    NUMBER("ball.saturation_max", saturation_max, nullptr, "1", 0, 1,
           "greatest saturation of the ball's pixels; purer ones do not belong to it"),
    NUMBER("ball.value_min", value_min, nullptr, "0.12", 0, 1,
           "least brightness (HSV value) of the ball's pixels; darker ones do not belong to it"),
    NUMBER("ball.radius", ball_radius, "m", "0", 0, 1,
           "the ball's true radius; a thing of another size is refused; 0 = not known, not "
           "checked"),
    NUMBER("ball.radius_min", radius_min, "deg", "0.35", 0.05, 80,
           "smallest apparent radius of the ball: half the angle under which an eye sees it"),
    NUMBER("ball.radius_max", radius_max, "deg", "40", 0.1, 80,
           "largest apparent radius of the ball: half the angle under which an eye sees it"),
    NUMBER("ball.coverage_min", coverage_min, nullptr, "0.5", 0.15, 1,
           "least share of the ball's outline that must be seen"),
    NUMBER("ball.fill_min", fill_min, nullptr, "0.5", 0.05, 1,
           "least share of the ball's disc that must have its colour"),
    NUMBER("ball.roughness", roughness, "px", "0.8", 0.05, 10,
           "greatest rms distance of the seen edge from the outline of a ball; 0.8 % of the radius "
           "where that is more; less where only a part of the outline is seen"),
    NUMBER("check.height", height_tolerance, "px", "3", 0.1, 100,
           "greatest difference between the ball's heights in the two pictures, corrected for "
           "vergence, in a picture 640 px wide; 2 % of the ball's radius where that is more"),
    NUMBER("check.size", size_tolerance, nullptr, "0.15", 0.01, 1,
           "greatest relative difference between the ball's sizes in the two pictures"),
    NUMBER("check.disparity_min", disparity_min, "px", "-300", -4000, 4000,
           "smallest disparity that is accepted, in a picture 640 px wide"),
    NUMBER("check.disparity_max", disparity_max, "px", "300", -4000, 4000,
           "largest disparity that is accepted, in a picture 640 px wide"),
    NUMBER(
        "track.margin", window_margin, "px", "24", 4, 1000,
        "distance by which the search window reaches beyond the expected ball, in a picture 640 px "
        "wide"),
    NUMBER("track.growth", window_growth, "px/s", "300", 0, 10000,
           "speed at which the search window grows while the ball is not seen, in a picture 640 px "
           "wide"),
    NUMBER("track.memory", memory, "s", "0.5", 0, 2,
           "time without a sighting after which the whole pictures are searched at once"),
    WHOLE("track.window_step", window_step, "px", "3", 1, 8,
          "in a search window every n-th pixel is looked at first, before the close look"),
    WHOLE("track.whole_step", whole_step, "px", "4", 1, 8,
          "in a whole picture every n-th pixel is looked at first, before the close look"),
    WHOLE("track.recheck", recheck, "pairs", "30", 0, 100000,
          "number of pairs seen in search windows after which the whole pictures are searched "
          "once"),
    NUMBER("bus.drop_after", drop_after, "s", "0.05", 0, 10,
           "age at which a waiting live pair is passed over; 0 = never; a pair is live when "
           "stamped with the present time, not with simulated time"),
    NUMBER("video.rate", video_rate, "1/s", "0", 0, 1000,
           "pairs per second from video files; 0 = as fast as they are processed"),
    {nullptr, OPTION_BOOL, 0, nullptr, nullptr, 0, 0, nullptr, nullptr},
};

static const char *contradiction(const vision_config &config)
{
    if (config.radius_min >= config.radius_max)
        return "ball.radius_min must be less than ball.radius_max";
    if (config.saturation_min >= config.saturation_max)
        return "ball.saturation_min must be less than ball.saturation_max";
    if (config.disparity_min >= config.disparity_max)
        return "check.disparity_min must be less than check.disparity_max";
    if (config.tag_dictionary > 0 && config.tag_id >= tag_count(config.tag_dictionary))
        return "marker.dictionary has no tag of the number marker.id";
    return nullptr;
}

int config_load(vision_config *config, const char *path, const char *const *overrides,
                int n_overrides, char *error, size_t error_size)
{
    if (options_load(table, config, &path, path ? 1 : 0, overrides, n_overrides, error, error_size))
        return -1;
    const char *wrong = contradiction(*config);
    if (wrong)
        snprintf(error, error_size, "%s: %s", path ? path : "options", wrong);
    return wrong ? -1 : 0;
}

void config_print(FILE *out)
{
    options_print(table, nullptr, out);
}

eyes_config config_eyes(const vision_config &c)
{
    const double scale = c.width / usual_width;
    eyes_config result;

    result.colour = {c.hue, c.hue_tolerance, c.saturation_min, c.saturation_max, c.value_min};
    result.limits = {c.radius_min, c.radius_max, c.coverage_min, c.fill_min, c.roughness};
    result.rig.left = {c.width,       c.height,   c.left_focal, c.left_centre_u, c.left_centre_v,
                       c.left_k1,     c.left_k2,  c.left_k3,    c.left_p1,       c.left_p2,
                       c.left_aspect, c.left_yaw, c.left_pitch, c.left_roll};
    result.rig.right = {c.width,          c.height,    c.right_focal,  c.right_centre_u,
                        c.right_centre_v, c.right_k1,  c.right_k2,     c.right_k3,
                        c.right_p1,       c.right_p2,  c.right_aspect, c.right_yaw,
                        c.right_pitch,    c.right_roll};
    result.rig.vergence = c.vergence;
    result.rig.baseline = c.baseline;
    result.tag = {c.tag_dictionary, c.tag_id};
    /* What a tag is found as: a ball whose diameter is its side. */
    result.rig.ball_radius = c.tag_dictionary > 0 ? c.tag_size / 2 : c.ball_radius;
    result.rig.height_tolerance = scale * c.height_tolerance;
    result.rig.size_tolerance = c.size_tolerance;
    result.rig.disparity_min = scale * c.disparity_min;
    result.rig.disparity_max = scale * c.disparity_max;
    result.window = {scale * c.window_margin, scale * c.window_growth,
                     static_cast<int64_t>(c.memory * 1e6)};
    result.window_step = c.window_step;
    result.whole_step = c.whole_step;
    result.most_apart = static_cast<int64_t>(c.most_apart * 1e6);
    result.recheck = c.recheck;
    return result;
}
