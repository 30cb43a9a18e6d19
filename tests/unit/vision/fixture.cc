#include "fixture.h"

#include <bot_core_images_t.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>

static const double degree = 3.14159265358979323846 / 180;

uint64_t fixture_seed(uint64_t usual)
{
    const char *given = std::getenv("REACH_TEST_SEED");
    const uint64_t seed = given ? std::strtoull(given, nullptr, 10) : usual;

    printf("REACH_TEST_SEED=%llu\n", static_cast<unsigned long long>(seed));
    return seed;
}

eyes_config fixture_config()
{
    const scene_eyes eyes = scene_default_eyes();
    eyes_config config = {};

    config.colour = {125 * degree, 35 * degree, 0.35, 1, 0.12};
    config.limits = {0.35 * degree, 5.25 * degree, 0.5, 0.5, 0.8};
    config.rig = {eyes.left, eyes.right, eyes.vergence, eyes.baseline, 0, 3, 0.15, -300, 300};
    config.window = {24, 300, 500000};
    config.window_step = 3;
    config.whole_step = 4;
    config.recheck = 30;
    return config;
}

picture_pair fixture_draw(const scene &what, const scene_eyes &eyes, std::mt19937_64 &random)
{
    picture_pair pair;

    pair.left = scene_draw(what, eyes, true, random);
    pair.right = scene_draw(what, eyes, false, random);
    return pair;
}

fixture_truth fixture_truth_of(const scene &what, const scene_eyes &eyes)
{
    fixture_truth truth;
    double u_left;
    double v_left;

    scene_project(eyes, true, what.spheres[0].centre, &u_left, &v_left);
    scene_project(eyes, false, what.spheres[0].centre, &truth.u_right, &truth.v_right);
    truth.disparity = u_left - truth.u_right;
    return truth;
}

scene fixture_plain_scene()
{
    scene what;

    what.spheres.push_back({{0.02, -0.03, 0.5}, 0.025, {0.16, 0.72, 0.22}});
    what.light = direction_normalised({0.3, -0.8, -0.6});
    return what;
}

encoded_image fixture_encoded(const picture &from)
{
    return {from.rgb.data(),
            from.rgb.size(),
            from.width,
            from.height,
            static_cast<size_t>(from.width) * 3,
            PIXEL_FORMAT_RGB};
}

std::vector<uint8_t> fixture_jpeg(const picture &from, int quality)
{
    const cv::Mat rgb(from.height, from.width, CV_8UC3, const_cast<uint8_t *>(from.rgb.data()));
    std::vector<uint8_t> bytes;
    cv::Mat bgr;

    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    return bytes;
}

static bot_core_image_t wrap(int width, int height, std::vector<uint8_t> *bytes, bool raw)
{
    bot_core_image_t image = {};

    image.width = width;
    image.height = height;
    image.row_stride = raw ? 3 * width : 0;
    image.pixelformat =
        raw ? BOT_CORE_IMAGE_T_PIXEL_FORMAT_RGB : BOT_CORE_IMAGE_T_PIXEL_FORMAT_MJPEG;
    image.size = static_cast<int32_t>(bytes->size());
    image.data = bytes->data();
    return image;
}

static std::vector<uint8_t> encode(int64_t utime, bot_core_image_t *left_right_other, int n = 2)
{
    const int16_t disparity = 4; /* bot_core.images_t's DISPARITY_ZIPPED */
    int16_t types[3] = {BOT_CORE_IMAGES_T_LEFT, BOT_CORE_IMAGES_T_RIGHT, disparity};
    const bot_core_images_t message = {utime, n, types, left_right_other};
    std::vector<uint8_t> bytes(static_cast<size_t>(bot_core_images_t_encoded_size(&message)));

    bot_core_images_t_encode(bytes.data(), 0, static_cast<int>(bytes.size()), &message);
    return bytes;
}

std::vector<uint8_t> fixture_message(int64_t utime, const picture_pair &pair, int quality)
{
    const bool raw = quality <= 0;
    std::vector<uint8_t> left = raw ? pair.left.rgb : fixture_jpeg(pair.left, quality);
    std::vector<uint8_t> right = raw ? pair.right.rgb : fixture_jpeg(pair.right, quality);
    bot_core_image_t images[2] = {wrap(pair.left.width, pair.left.height, &left, raw),
                                  wrap(pair.right.width, pair.right.height, &right, raw)};

    return encode(utime, images);
}

std::vector<uint8_t> fixture_message_with_disparity(int64_t utime)
{
    std::vector<uint8_t> pixels(8 * 4 * 3, 7);
    std::vector<uint8_t> zipped(11, 1);
    bot_core_image_t images[3] = {wrap(8, 4, &pixels, true), wrap(8, 4, &pixels, true),
                                  wrap(8, 4, &zipped, true)};

    images[2].pixelformat = 0;
    images[2].row_stride = 0;
    return encode(utime, images, 3);
}

std::vector<uint8_t> fixture_small_message()
{
    std::vector<uint8_t> pixels(5 * 4 * 3, 7);
    uint8_t value[3] = {1, 2, 3};
    char key[] = "gain";
    bot_core_image_metadata_t metadata = {key, 3, value};
    bot_core_image_t images[2] = {wrap(5, 4, &pixels, true), wrap(5, 4, &pixels, true)};

    images[0].nmetadata = 1;
    images[0].metadata = &metadata;
    return encode(123456, images);
}
