/* Where pairs of pictures come from: the bus, a log of it, two cameras, or two video files. */
#ifndef VISION_PICTURES_SOURCE_H
#define VISION_PICTURES_SOURCE_H

#include <lcm/lcm.h>

#include <cstddef>
#include <cstdint>
#include <memory>

#include "vision/ball/camera.h"
#include "vision/pictures/image_message.h"

/* A pair as it arrives. Its bytes are only there while the receiver runs. */
struct incoming_pair {
    image_message images;
    int64_t waited; /* since it arrived, as far as known; us */
};

class pair_receiver
{
public:
    virtual ~pair_receiver() = default;
    virtual void take(const incoming_pair &pair) = 0;
    /* Something came that cannot be read; `reason` is a constant text. */
    virtual void refuse(const char *reason) = 0;
};

enum source_state { SOURCE_OPEN, SOURCE_ENDED, SOURCE_FAILED };

class source
{
public:
    virtual ~source() = default;
    /* Waits up to `milliseconds` and hands at most a few pairs to the receiver. SOURCE_ENDED: there
     * are no more; SOURCE_FAILED: it broke, and what broke has been logged. */
    virtual source_state poll(int milliseconds) = 0;
};

/* Pairs from channel STEREO_IMAGES. The bus and the receiver must outlive the source. */
std::unique_ptr<source> source_bus(lcm_t *lcm, const char *channel, pair_receiver *receiver,
                                   char *error, size_t error_size);

/* The same from a log of lcm-logger's, as fast as pairs are seen; ends with it. */
std::unique_ptr<source> source_log(const char *path, const char *channel, pair_receiver *receiver,
                                   char *error, size_t error_size);

/* Two V4L2 devices ("/dev/video0"), stamped when the pair was grabbed, epoch us. Motion JPEG, the
 * eye's size and `rate` pictures a second (0: not) are asked of both; what they give is logged. */
std::unique_ptr<source> source_cameras(const char *left, const char *right, const camera &eye,
                                       double rate, pair_receiver *receiver, char *error,
                                       size_t error_size);

/* One camera ("/dev/..."), one picture or one video file in place of both eyes. */
std::unique_ptr<source> source_one(const char *name, const camera &eye, double rate,
                                   pair_receiver *receiver, char *error, size_t error_size);

/* Two video files of the same length, stamped from 1 s on by their frame rate. Read at `rate`
 * pairs a second, 0 = as fast as they are seen. */
std::unique_ptr<source> source_videos(const char *left, const char *right, double rate,
                                      pair_receiver *receiver, char *error, size_t error_size);

#endif
