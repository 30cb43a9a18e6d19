/* Pictures as cameras send them: JPEG with bytes too many or too few, and raw formats. */
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <turbojpeg.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "fixture.h"
#include "vision/pictures/decode.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

using bytes = std::vector<uint8_t>;

static picture drawn; /* once, before Check forks a process for each test */
static const camera eye = scene_default_eyes().left;

/* Greatest mean difference of a channel from what was drawn, levels; or -1 when refused. */
static double difference(decoder *decoding, const bytes &data, int32_t format, size_t stride)
{
    const encoded_image image = {data.data(), data.size(), eye.width, eye.height, stride, format};
    image_view view;
    double sum = 0;

    if (decoding->decode(image, eye, &view))
        return -1;
    for (int row = 0; row < view.height; row++)
        for (int column = 0; column < view.width; column++) {
            const uint8_t *is = image_pixel(view, column, row);
            const uint8_t *was = image_pixel(drawn.view(), column, row);
            for (int c = 0; c < 3; c++)
                sum += std::abs(is[c == 1   ? 1
                                   : c == 0 ? image_red(view)
                                            : 2 - image_red(view)] -
                                was[c]);
        }
    return sum / (3.0 * view.width * view.height);
}

static bytes compress(int sampling, int flags)
{
    tjhandle writer = tjInitCompress();
    unsigned char *out = nullptr;
    unsigned long size = 0;

    ck_assert_int_eq(tjCompress2(writer, drawn.rgb.data(), drawn.width, 3 * drawn.width,
                                 drawn.height, TJPF_RGB, &out, &size, sampling, 95, flags),
                     0);
    bytes result(out, out + size);
    tjFree(out);
    tjDestroy(writer);
    return result;
}

/* Where the segment of a marker begins; its length follows the marker. */
static size_t find_marker(const bytes &jpeg, uint8_t marker)
{
    for (size_t at = 2; at + 4 < jpeg.size() && jpeg[at] == 0xff;
         at += 2 + static_cast<size_t>(jpeg[at + 2] << 8 | jpeg[at + 3]))
        if (jpeg[at + 1] == marker)
            return at;
    return 0;
}

static void remove_segments(bytes *jpeg, uint8_t marker)
{
    for (size_t at = find_marker(*jpeg, marker); at; at = find_marker(*jpeg, marker)) {
        const auto start = jpeg->begin() + static_cast<long>(at);
        jpeg->erase(start, start + 2 + ((*jpeg)[at + 2] << 8 | (*jpeg)[at + 3]));
    }
}

static double jpeg_difference(const bytes &data)
{
    decoder decoding;

    return difference(&decoding, data, PIXEL_FORMAT_MJPEG, 0);
}

START_TEST(every_chroma_sampling_is_taken)
{
    for (int sampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_440, TJSAMP_411})
        for (int flags : {0, TJFLAG_PROGRESSIVE}) {
            const double off = jpeg_difference(compress(sampling, flags));
            ck_assert_double_ge(off, 0);
            ck_assert_double_lt(off, 4);
        }
    ck_assert_double_lt(jpeg_difference(compress(TJSAMP_GRAY, 0)), 0);
}
END_TEST

START_TEST(what_is_mended_without_loss_is_taken)
{
    const bytes whole = compress(TJSAMP_420, 0);
    const double off = jpeg_difference(whole);
    bytes no_end(whole.begin(), whole.end() - 2);
    bytes zeros = no_end;

    ck_assert_double_eq(jpeg_difference(no_end), off);
    zeros.insert(zeros.end(), 7, 0);
    ck_assert_double_eq(jpeg_difference(zeros), off);
    zeros.insert(zeros.end(), {0xff, 0xd9});
    ck_assert_double_eq(jpeg_difference(zeros), off);
}
END_TEST

/* As a known webcam sends: some bytes more before a restart marker. */
START_TEST(bytes_before_a_restart_marker_are_passed_over)
{
    const cv::Mat rgb(drawn.height, drawn.width, CV_8UC3, drawn.rgb.data());
    cv::Mat bgr;
    bytes jpeg;

    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    cv::imencode(".jpg", bgr, jpeg, {cv::IMWRITE_JPEG_RST_INTERVAL, 40});
    const double off = jpeg_difference(jpeg);
    const bytes marker = {0xff, 0xd3};
    const auto restart = std::search(jpeg.begin(), jpeg.end(), marker.begin(), marker.end());
    ck_assert(restart != jpeg.end());
    jpeg.insert(restart, {0x12, 0x34, 0x56, 0x78});
    ck_assert_double_ge(off, 0);
    ck_assert_double_eq(jpeg_difference(jpeg), off);
}
END_TEST

/* Motion JPEG leaves the standard Huffman tables out; the decoder had others just before. */
START_TEST(standard_tables_come_back)
{
    const bytes own_tables = compress(TJSAMP_422, TJFLAG_PROGRESSIVE);
    bytes none = compress(TJSAMP_422, 0);
    decoder decoding;

    const double off = jpeg_difference(none);
    remove_segments(&none, 0xc4);
    ck_assert_uint_eq(find_marker(none, 0xc4), 0);
    ck_assert_double_ge(difference(&decoding, own_tables, PIXEL_FORMAT_MJPEG, 0), 0);
    ck_assert_double_eq(difference(&decoding, none, PIXEL_FORMAT_MJPEG, 0), off);
}
END_TEST

START_TEST(what_is_cut_is_refused)
{
    const bytes whole = compress(TJSAMP_420, 0);

    for (size_t missing : {whole.size() / 2, whole.size() / 10, size_t{40}}) {
        bytes cut(whole.begin(), whole.end() - static_cast<long>(missing));
        ck_assert_double_lt(jpeg_difference(cut), 0);
        cut.insert(cut.end(), {0xff, 0xd9}); /* as if it were whole */
        ck_assert_double_lt(jpeg_difference(cut), 0);
    }
}
END_TEST

/* From RGB to YUV 4:2:2 and 4:2:0, by the pixel (ITU-R BT.601, 16 .. 235). */
static void to_yuv(int column, int row, int yuv[3])
{
    const uint8_t *rgb = image_pixel(drawn.view(), column, row);

    yuv[0] = static_cast<int>(16.5 + 0.257 * rgb[0] + 0.504 * rgb[1] + 0.098 * rgb[2]);
    yuv[1] = static_cast<int>(128.5 - 0.148 * rgb[0] - 0.291 * rgb[1] + 0.439 * rgb[2]);
    yuv[2] = static_cast<int>(128.5 + 0.439 * rgb[0] - 0.368 * rgb[1] - 0.071 * rgb[2]);
}

static bytes packed_yuv(bool luma_first)
{
    bytes data;

    for (int i = 0; i < eye.width * eye.height; i++) {
        int yuv[3];
        to_yuv(i % eye.width, i / eye.width, yuv);
        const int chroma = yuv[1 + i % 2];
        data.push_back(static_cast<uint8_t>(luma_first ? yuv[0] : chroma));
        data.push_back(static_cast<uint8_t>(luma_first ? chroma : yuv[0]));
    }
    return data;
}

static bytes planar_yuv()
{
    bytes data;
    int yuv[3];

    for (int i = 0; i < eye.width * eye.height; i++) {
        to_yuv(i % eye.width, i / eye.width, yuv);
        data.push_back(static_cast<uint8_t>(yuv[0]));
    }
    for (int row = 0; row < eye.height; row += 2)
        for (int column = 0; column < eye.width; column += 2) {
            to_yuv(column, row, yuv);
            data.push_back(static_cast<uint8_t>(yuv[1]));
            data.push_back(static_cast<uint8_t>(yuv[2]));
        }
    return data;
}

/* `first`: the channels of the first row's two pixels and of the second's. */
static bytes bayer(const char *pattern)
{
    bytes data;

    for (int i = 0; i < eye.width * eye.height; i++) {
        const int column = i % eye.width;
        const int row = i / eye.width;
        const char colour = pattern[2 * (row % 2) + column % 2];
        data.push_back(image_pixel(drawn.view(), column, row)[strchr("RGB", colour) - "RGB"]);
    }
    return data;
}

START_TEST(raw_formats_are_converted)
{
    const struct {
        int32_t format;
        bytes data;
        int row_bytes;
    } cases[] = {
        {PIXEL_FORMAT_YUYV, packed_yuv(true), 2},    {PIXEL_FORMAT_UYVY, packed_yuv(false), 2},
        {PIXEL_FORMAT_NV12, planar_yuv(), 1},        {PIXEL_FORMAT_BAYER_BGGR, bayer("BGGR"), 1},
        {PIXEL_FORMAT_BAYER_GBRG, bayer("GBRG"), 1}, {PIXEL_FORMAT_BAYER_GRBG, bayer("GRBG"), 1},
        {PIXEL_FORMAT_BAYER_RGGB, bayer("RGGB"), 1},
    };
    decoder decoding;

    for (const auto &one : cases) {
        const double off = difference(&decoding, one.data, one.format,
                                      static_cast<size_t>(one.row_bytes * eye.width));
        ck_assert_double_ge(off, 0);
        ck_assert_double_lt(off, 5);
    }
}
END_TEST

/* Grey where a coloured ball is sought: name, number and what is taken. For a tag it is enough. */
START_TEST(grey_is_refused_by_name_and_number)
{
    const bytes levels(static_cast<size_t>(eye.width) * eye.height, 90);
    encoded_image raw = {
        levels.data(),    levels.size(), eye.width, eye.height, static_cast<size_t>(eye.width),
        PIXEL_FORMAT_GRAY};
    const bytes jpeg = compress(TJSAMP_GRAY, 0);
    encoded_image compressed = {jpeg.data(), jpeg.size(), eye.width,
                                eye.height,  0,           PIXEL_FORMAT_MJPEG};
    decoder colours;
    decoder any(true);
    image_view view;

    const char *wrong = colours.decode(raw, eye, &view);
    ck_assert_ptr_nonnull(wrong);
    ck_assert_ptr_nonnull(strstr(wrong, "GRAY, pixelformat 1497715271"));
    ck_assert_ptr_nonnull(strstr(wrong, "send MJPEG, RGB, BGR"));
    wrong = colours.decode(compressed, eye, &view);
    ck_assert_ptr_nonnull(wrong);
    ck_assert_ptr_nonnull(strstr(wrong, "MJPEG, pixelformat 1196444237"));
    ck_assert_ptr_null(any.decode(raw, eye, &view));
    ck_assert_int_eq(image_pixel(view, 3, 4)[2], 90);
    ck_assert_ptr_null(any.decode(compressed, eye, &view));
}
END_TEST

START_TEST(both_sizes_of_a_jpeg_are_named)
{
    const bytes jpeg = compress(TJSAMP_420, 0);
    camera other = eye;
    decoder decoding;
    image_view view;

    other.width = 320;
    const char *wrong = decoding.decode(
        {jpeg.data(), jpeg.size(), other.width, other.height, 0, PIXEL_FORMAT_MJPEG}, other, &view);
    ck_assert_ptr_nonnull(wrong);
    ck_assert_ptr_nonnull(strstr(wrong, "640 x 480"));
    ck_assert_ptr_nonnull(strstr(wrong, "320 x 480"));
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        every_chroma_sampling_is_taken,
        what_is_mended_without_loss_is_taken,
        bytes_before_a_restart_marker_are_passed_over,
        standard_tables_come_back,
        what_is_cut_is_refused,
        raw_formats_are_converted,
        grey_is_refused_by_name_and_number,
        both_sizes_of_a_jpeg_are_named,
    };
    std::mt19937_64 random(51);

    drawn = scene_draw(fixture_plain_scene(), scene_default_eyes(), true, random);
    return SUITE_RUN("vision decode", tests);
}
