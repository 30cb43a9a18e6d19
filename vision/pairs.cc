#include "vision/pairs.h"

#include <cstring>

#include "common/logs/event_log.h"
#include "common/program/log.h"

static const char channel[] = "STEREO_IMAGES";
static const char bus_name[] = "bus"; /* of --learn-colour */

/* --learn-colour names its source itself, unless that is "bus". */
static const char *one_source(const arguments &given)
{
    return given.learn_colour && strcmp(given.learn_colour, bus_name) != 0 ? given.learn_colour
                                                                           : nullptr;
}

bool pairs_on_bus(const arguments &given)
{
    return !given.cameras[0] && !given.videos[0] && !given.log && !one_source(given);
}

static std::unique_ptr<source> open_any(const arguments &given, const vision_config &config,
                                        lcm_t *lcm, pair_receiver *receiver, char *error,
                                        size_t error_size)
{
    const camera eye = config_eyes(config).rig.left;
    const char *const one = one_source(given);

    if (given.cameras[0])
        return source_cameras(given.cameras[0], given.cameras[1], eye, config.camera_rate, receiver,
                              error, error_size);
    if (given.videos[0])
        return source_videos(given.videos[0], given.videos[1], config.video_rate, receiver, error,
                             error_size);
    if (given.log)
        return source_log(given.log, channel, receiver, error, error_size);
    if (one && event_log_begins(one))
        return source_log(one, channel, receiver, error, error_size);
    if (one)
        return source_one(one, eye, config.camera_rate, receiver, error, error_size);
    return source_bus(lcm, channel, receiver, error, error_size);
}

std::unique_ptr<source> pairs_open(const arguments &given, const vision_config &config, lcm_t *lcm,
                                   pair_receiver *receiver)
{
    char error[512] = "";
    std::unique_ptr<source> pairs = open_any(given, config, lcm, receiver, error, sizeof error);

    if (!pairs)
        log_error("%s", error);
    return pairs;
}
