/* The raw pixel formats of bot_core.image_t that are taken. */
#ifndef VISION_PICTURES_FORMATS_H
#define VISION_PICTURES_FORMATS_H

#include <cstddef>
#include <cstdint>

/* bot_core.image_t.pixelformat: mostly the four letters of the format's name, first letter lowest.
 */
enum pixel_format : int32_t {
    PIXEL_FORMAT_GRAY = 1497715271,
    PIXEL_FORMAT_RGB = 859981650,
    PIXEL_FORMAT_BGR = 861030210,
    PIXEL_FORMAT_RGBA = 876758866,
    PIXEL_FORMAT_BGRA = 877807426,
    PIXEL_FORMAT_YUYV = 1448695129,
    PIXEL_FORMAT_UYVY = 1498831189,
    PIXEL_FORMAT_NV12 = 842094158,
    PIXEL_FORMAT_I420 = 808596553,
    PIXEL_FORMAT_BAYER_BGGR = 825770306,
    PIXEL_FORMAT_BAYER_GBRG = 844650584,
    PIXEL_FORMAT_BAYER_GRBG = 861427800,
    PIXEL_FORMAT_BAYER_RGGB = 878205016,
    PIXEL_FORMAT_MJPEG = 1196444237,
};

struct format {
    int32_t number;
    const char *name;
    int row_bytes; /* a pixel in a row of the first plane */
    int even;      /* width and height must be multiples of this */
    bool planes;   /* half as many rows again follow, with the colours */
    int to_bgr;    /* OpenCV's conversion to BGR, or one of: */
};
enum { FORMAT_AS_IT_IS = -1, FORMAT_COMPRESSED = -2, FORMAT_GREY = -3 };

/* The row of a number, or nullptr. */
const format *format_of(int32_t number);

/* What can be sent, for complaints. */
#define FORMATS_TAKEN "MJPEG, RGB, BGR, RGBA, BGRA, YUYV, UYVY, NV12, I420 or 8-bit BAYER"

/* "PIXELFORMAT is not taken ..." with the number, its name if it is a known one, and what is taken.
 */
void format_complain(int32_t number, char *text, size_t size);

#endif
