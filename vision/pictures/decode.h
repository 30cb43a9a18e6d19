/* From a picture as it came to one that can be looked at. */
#ifndef VISION_PICTURES_DECODE_H
#define VISION_PICTURES_DECODE_H

#include <cstdint>
#include <vector>

#include "vision/ball/camera.h"
#include "vision/ball/image.h"
#include "vision/pictures/image_message.h"

/* One decoder per eye: the picture lives in it until the next. */
class decoder
{
public:
    /* `grey_too`: pictures without colours are taken as well, for what needs none. */
    explicit decoder(bool grey_too = false) : grey_too_(grey_too) {}

    /* RGB and BGR are not copied: `view` then points into the message. A picture must have the
     * size that the camera is configured for, which bounds what a hostile JPEG can ask for.
     *   returns nullptr, or why the picture is unusable; the text lives as long as the picture. */
    const char *decode(const encoded_image &from, const camera &eye, image_view *view);

private:
    const char *convert(const encoded_image &from, int to_bgr, int rows);

    const char *decompress(const encoded_image &from);
    const char *complain_of_grey(const encoded_image &from);

    bool grey_too_;
    std::vector<uint8_t> pixels_;
    char wrong_[256] = "";
};

#endif
