/* From a picture as it came to one that can be looked at. */
#ifndef VISION_PICTURES_DECODE_H
#define VISION_PICTURES_DECODE_H

#include <cstdint>
#include <vector>

#include "vision/ball/camera.h"
#include "vision/ball/image.h"
#include "vision/pictures/image_message.h"

/* Holds what decoding JPEG needs. One decoder per eye: the picture lives in it until the next. */
class decoder
{
public:
    decoder();
    ~decoder();
    decoder(const decoder &) = delete;
    decoder &operator=(const decoder &) = delete;

    /* Raw pictures are not copied: `view` then points into the message. A picture must have the
     * size that the camera is configured for, which bounds what a hostile JPEG can ask for.
     *   returns nullptr, or why the picture is unusable (a constant text). */
    const char *decode(const encoded_image &from, const camera &eye, image_view *view);

private:
    const char *decode_jpeg(const encoded_image &from, const camera &eye, image_view *view);

    void *jpeg_;
    std::vector<uint8_t> pixels_;
};

#endif
