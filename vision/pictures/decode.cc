#include "vision/pictures/decode.h"

#include <opencv2/imgproc.hpp>

#include <cstdio>

#include "vision/pictures/jpeg.h"

/* To BGR, into pixels_. `rows`: of all planes. */
const char *decoder::convert(const encoded_image &from, int to_bgr, int rows)
{
    const format &kind = *format_of(from.format);
    const cv::Mat raw(rows, from.width, CV_8UC(kind.row_bytes), const_cast<uint8_t *>(from.data),
                      from.stride);
    cv::Mat bgr(from.height, from.width, CV_8UC3, pixels_.data());

    cv::cvtColor(raw, bgr, to_bgr);
    return bgr.data == pixels_.data() ? nullptr : "it cannot be converted";
}

const char *decoder::decompress(const encoded_image &from)
{
    jpeg_header header;
    const char *wrong =
        jpeg_decode(from.data, from.size, from.width, from.height, pixels_.data(), &header);

    if (wrong && header.width > 0 && (header.width != from.width || header.height != from.height)) {
        snprintf(wrong_, sizeof wrong_, "its JPEG header names %d x %d pixels, its message %d x %d",
                 header.width, header.height, from.width, from.height);
        return wrong_;
    }
    return !wrong && header.grey && !grey_too_ ? complain_of_grey(from) : wrong;
}

const char *decoder::complain_of_grey(const encoded_image &from)
{
    snprintf(
        wrong_, sizeof wrong_,
        "it is grey (%s, pixelformat %d), and a ball is found by its colour: send " FORMATS_TAKEN
        " in colour, or mark the hand with a tag (marker.dictionary)",
        format_of(from.format)->name, static_cast<int>(from.format));
    return wrong_;
}

const char *decoder::decode(const encoded_image &from, const camera &eye, image_view *view)
{
    const format &kind = *format_of(from.format);
    const size_t row = static_cast<size_t>(from.width) * 3;
    const char *wrong = nullptr;

    if (from.width != eye.width || from.height != eye.height) {
        snprintf(wrong_, sizeof wrong_,
                 "it has %d x %d pixels, but camera.width and camera.height say %d x %d",
                 from.width, from.height, eye.width, eye.height);
        return wrong_;
    }
    if (kind.to_bgr == FORMAT_GREY && !grey_too_)
        return complain_of_grey(from);
    if (kind.to_bgr == FORMAT_AS_IT_IS) {
        *view = {from.data, from.width, from.height, from.stride,
                 from.format == PIXEL_FORMAT_RGB ? PIXEL_RGB : PIXEL_BGR};
        return nullptr;
    }
    pixels_.resize(row * static_cast<size_t>(from.height));
    if (kind.to_bgr == FORMAT_COMPRESSED)
        wrong = decompress(from);
    else if (kind.to_bgr == FORMAT_GREY)
        wrong = convert(from, cv::COLOR_GRAY2BGR, from.height);
    else
        wrong = convert(from, kind.to_bgr, from.height * (kind.planes ? 3 : 2) / 2);
    *view = {pixels_.data(), from.width, from.height, row,
             kind.to_bgr == FORMAT_COMPRESSED ? PIXEL_RGB : PIXEL_BGR};
    return wrong;
}
