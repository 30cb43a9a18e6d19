/* A picture that somebody else owns: 8-bit colour, three bytes a pixel. */
#ifndef VISION_BALL_IMAGE_H
#define VISION_BALL_IMAGE_H

#include <cstddef>
#include <cstdint>

enum pixel_order { PIXEL_RGB, PIXEL_BGR };

struct image_view {
    const uint8_t *data = nullptr;
    int width = 0;     /* px */
    int height = 0;    /* px */
    size_t stride = 0; /* bytes from one row to the next */
    pixel_order order = PIXEL_RGB;
};

/* A part of a picture, px; `right` and `bottom` are the first column and row outside it. */
struct image_region {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

inline const uint8_t *image_pixel(const image_view &image, int column, int row)
{
    return image.data + static_cast<size_t>(row) * image.stride + static_cast<size_t>(column) * 3;
}

/* Byte of a pixel that holds red; blue is byte 2 - image_red(image). */
inline int image_red(const image_view &image)
{
    return image.order == PIXEL_RGB ? 0 : 2;
}

/* The region's part that lies inside the picture; empty when right <= left or bottom <= top. */
inline image_region image_clip(const image_view &image, image_region region)
{
    region.left = region.left < 0 ? 0 : region.left;
    region.top = region.top < 0 ? 0 : region.top;
    region.right = region.right > image.width ? image.width : region.right;
    region.bottom = region.bottom > image.height ? image.height : region.bottom;
    return region;
}

inline image_region image_whole(const image_view &image)
{
    return {0, 0, image.width, image.height};
}

#endif
