/* From pixels to the bytes of a bot_core images_t message: LEFT, then RIGHT, raw or JPEG. */
#ifndef SIMROBOT_EYES_IMAGE_MESSAGE_H
#define SIMROBOT_EYES_IMAGE_MESSAGE_H

#include <memory>
#include <string>
#include <vector>

#include "simrobot/setup/config.h"

namespace sim
{

/* A named block of bytes that goes with one of the images. */
struct ImageNote {
    int eye; /* 0 left, 1 right */
    std::string key;
    std::vector<uint8_t> value;
};

class ImageMessage
{
public:
    /*   returns nullptr with one line in `error` when the JPEG library fails. */
    static std::unique_ptr<ImageMessage> create(const Config &config, std::string *error);
    ~ImageMessage();
    ImageMessage(const ImageMessage &) = delete;
    ImageMessage &operator=(const ImageMessage &) = delete;

    /* `pixels`: both images side by side as Renderer draws them.
     *   returns the message's bytes, or none with one line in `error`. */
    std::vector<uint8_t> encode(int64_t utime, const std::vector<uint8_t> &pixels,
                                std::string *error, const std::vector<ImageNote> &notes = {});

private:
    explicit ImageMessage(const Config &config);

    bool compress(const uint8_t *pixels, int eye, std::string *error);
    void strip(const uint8_t *pixels, int eye);

    const int width_, height_, quality_;
    const bool jpeg_;
    void *compressor_ = nullptr; /* tjhandle */
    std::vector<uint8_t> data_[2];
    unsigned long size_[2] = {0, 0};
};

} // namespace sim
#endif
