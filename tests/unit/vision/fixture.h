/* What the tests of vision share: settings that fit the drawn scenes, and messages made by the
 * generated encoder. */
#ifndef TEST_FIXTURE_H
#define TEST_FIXTURE_H

#include <cstdint>
#include <random>
#include <vector>

#include "scene.h"
#include "vision/ball/eyes.h"
#include "vision/pictures/image_message.h"

/* The seed of a randomised test: $REACH_TEST_SEED, else this one; printed. */
uint64_t fixture_seed(uint64_t usual);

/* Settings for scene_default_eyes() and the ball of scene_random(). */
eyes_config fixture_config();

struct picture_pair {
    picture left;
    picture right;
};

picture_pair fixture_draw(const scene &what, const scene_eyes &eyes, std::mt19937_64 &random);

/* What the marker should say of the first sphere. */
struct fixture_truth {
    double u_right;
    double v_right;
    double disparity;
};

fixture_truth fixture_truth_of(const scene &what, const scene_eyes &eyes);

/* A ball straight ahead, evenly lit. */
scene fixture_plain_scene();

/* The picture as it lies in a message; points into it. */
encoded_image fixture_encoded(const picture &from);

/* JPEG bytes of a picture. */
std::vector<uint8_t> fixture_jpeg(const picture &from, int quality);

/* An images_t message by the generated encoder: raw RGB, or JPEG when `quality` > 0. */
std::vector<uint8_t> fixture_message(int64_t utime, const picture_pair &pair, int quality);

/* A small message with a third image that is no picture. */
std::vector<uint8_t> fixture_message_with_disparity(int64_t utime);

/* A small message with metadata, for taking apart byte by byte. */
std::vector<uint8_t> fixture_small_message();

#endif
