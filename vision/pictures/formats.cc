#include "vision/pictures/formats.h"

#include <opencv2/imgproc.hpp>

#include <cstdio>

static const format formats[] = {
    {PIXEL_FORMAT_RGB, "RGB", 3, 1, false, FORMAT_AS_IT_IS},
    {PIXEL_FORMAT_BGR, "BGR", 3, 1, false, FORMAT_AS_IT_IS},
    {PIXEL_FORMAT_MJPEG, "MJPEG", 0, 1, false, FORMAT_COMPRESSED},
    {PIXEL_FORMAT_GRAY, "GRAY", 1, 1, false, FORMAT_GREY},
    {PIXEL_FORMAT_RGBA, "RGBA", 4, 1, false, cv::COLOR_RGBA2BGR},
    {PIXEL_FORMAT_BGRA, "BGRA", 4, 1, false, cv::COLOR_BGRA2BGR},
    {PIXEL_FORMAT_YUYV, "YUYV", 2, 2, false, cv::COLOR_YUV2BGR_YUYV},
    {PIXEL_FORMAT_UYVY, "UYVY", 2, 2, false, cv::COLOR_YUV2BGR_UYVY},
    {PIXEL_FORMAT_NV12, "NV12", 1, 2, true, cv::COLOR_YUV2BGR_NV12},
    {PIXEL_FORMAT_I420, "I420", 1, 4, true, cv::COLOR_YUV2BGR_I420},
    {PIXEL_FORMAT_BAYER_BGGR, "BAYER_BGGR", 1, 2, false, cv::COLOR_BayerBGGR2BGR},
    {PIXEL_FORMAT_BAYER_GBRG, "BAYER_GBRG", 1, 2, false, cv::COLOR_BayerGBRG2BGR},
    {PIXEL_FORMAT_BAYER_GRBG, "BAYER_GRBG", 1, 2, false, cv::COLOR_BayerGRBG2BGR},
    {PIXEL_FORMAT_BAYER_RGGB, "BAYER_RGGB", 1, 2, false, cv::COLOR_BayerRGGB2BGR},
};

/* Others of bot_core's numbers, for complaints. */
static const struct {
    int32_t number;
    const char *name;
} others[] = {
    {827677001, "IYU1"},
    {844454217, "IYU2"},
    {842093913, "YUV420"},
    {1345401140, "YUV411P"},
    {826360386, "BE_BAYER16_BGGR"},
    {843137602, "BE_BAYER16_GBRG"},
    {859914818, "BE_BAYER16_GRBG"},
    {876692034, "BE_BAYER16_RGGB"},
    {826360396, "LE_BAYER16_BGGR"},
    {843137612, "LE_BAYER16_GBRG"},
    {859914828, "LE_BAYER16_GRBG"},
    {876692044, "LE_BAYER16_RGGB"},
    {357, "BE_GRAY16"},
    {909199180, "LE_GRAY16"},
    {358, "BE_RGB16"},
    {1279412050, "LE_RGB16"},
    {359, "BE_SIGNED_GRAY16"},
    {360, "BE_SIGNED_RGB16"},
    {842221382, "FLOAT_GRAY32"},
};

const format *format_of(int32_t number)
{
    for (const format &one : formats)
        if (one.number == number)
            return &one;
    return nullptr;
}

void format_complain(int32_t number, char *text, size_t size)
{
    const char *name = "of no known name";

    for (const auto &one : others)
        if (one.number == number)
            name = one.name;
    snprintf(text, size, "an image's pixelformat %d (%s) is not taken; send " FORMATS_TAKEN,
             static_cast<int>(number), name);
}
