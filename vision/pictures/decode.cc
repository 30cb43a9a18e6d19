#include "vision/pictures/decode.h"

#include <turbojpeg.h>

static const char wrong_size[] =
    "it has not the size that the configuration gives the camera (camera.width, camera.height)";

decoder::decoder() : jpeg_(tjInitDecompress()) {}

decoder::~decoder()
{
    if (jpeg_)
        tjDestroy(jpeg_);
}

const char *decoder::decode_jpeg(const encoded_image &from, const camera &eye, image_view *view)
{
    const unsigned long size = from.size;
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colours = 0;

    if (!jpeg_)
        return "the JPEG decoder could not be made";
    if (tjDecompressHeader3(jpeg_, from.data, size, &width, &height, &subsampling, &colours) < 0)
        return "its JPEG header is damaged";
    if (width != eye.width || height != eye.height)
        return wrong_size;
    if (colours == TJCS_GRAY)
        return "it is grey: a ball is found by its colour";
    pixels_.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 3);
    if (tjDecompress2(jpeg_, from.data, size, pixels_.data(), width, 3 * width, height, TJPF_RGB,
                      TJFLAG_LIMITSCANS) < 0)
        return "its JPEG data are damaged";
    *view = {pixels_.data(), width, height, static_cast<size_t>(width) * 3, PIXEL_RGB};
    return nullptr;
}

const char *decoder::decode(const encoded_image &from, const camera &eye, image_view *view)
{
    if (from.width != eye.width || from.height != eye.height)
        return wrong_size;
    if (from.format == PIXEL_FORMAT_MJPEG)
        return decode_jpeg(from, eye, view);
    if (from.format == PIXEL_FORMAT_GRAY)
        return "it is grey: a ball is found by its colour";
    *view = {from.data, from.width, from.height, from.stride,
             from.format == PIXEL_FORMAT_RGB ? PIXEL_RGB : PIXEL_BGR};
    return nullptr;
}
