/* Pairs that cannot be what they should: swapped, frozen, late, stamped apart. */
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "common/program/log.h"
#include "fixture.h"
#include "vision/answers/doubts.h"
#include "vision/answers/observer.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int64_t period = 33000; /* us */
static const int swing_pairs = 12;
static const int64_t swing_period = 90000; /* us */
static const int most_late = 2;            /* pairs */

/* What is said within a good second of pairs; each byte changes every pair unless it is frozen. */
static const char *say(bool left_frozen, bool right_frozen, const stereo_marker &marker,
                       bool grey = false)
{
    const char *said = nullptr;
    uint8_t left[2] = {1, 1};
    uint8_t right[2] = {2, 2};
    doubts all;

    for (int i = 0; i < 33 && !said; i++) {
        image_message pair;
        pair.utime = 1000000 + i * period;
        left[0] = static_cast<uint8_t>(left_frozen ? 1 : i);
        right[0] = static_cast<uint8_t>(right_frozen ? 1 : i);
        pair.left.data = left;
        pair.right.data = right;
        pair.left.size = pair.right.size = 2;
        said = doubts_add(&all, pair, marker, grey);
    }
    return said;
}

START_TEST(what_cannot_be_is_said_within_a_second)
{
    stereo_marker good;
    stereo_marker behind;
    stereo_marker heights;
    stereo_marker sizes;

    good.reason = STEREO_SEEN;
    behind.reason = STEREO_SEEN;
    behind.meets_behind = true;
    heights.reason = STEREO_HEIGHTS_DIFFER;
    sizes.reason = STEREO_SIZES_DIFFER;
    ck_assert_ptr_null(say(false, false, good));
    ck_assert_ptr_null(say(true, true, good)); /* a simulated robot at rest */
    ck_assert_ptr_nonnull(strstr(say(true, false, good), "left eye"));
    ck_assert_ptr_nonnull(strstr(say(false, true, good), "right eye"));
    ck_assert_ptr_nonnull(strstr(say(false, false, behind), "swapped"));
    ck_assert_ptr_nonnull(strstr(say(false, false, heights), "late"));
    ck_assert_ptr_nonnull(strstr(say(false, false, sizes), "ball.radius"));
    ck_assert_ptr_nonnull(strstr(say(false, false, good, true), "no colour"));
}
END_TEST

START_TEST(swapped_parallel_eyes_meet_behind)
{
    std::mt19937_64 random(71);
    scene_eyes rig = scene_default_eyes();
    eyes_config config = fixture_config();
    eyes who;

    rig.vergence = config.rig.vergence = 0;
    rig.baseline = config.rig.baseline = 0.06;
    const picture_pair pair = fixture_draw(fixture_plain_scene(), rig, random);
    eyes_init(&who, config);
    ck_assert(!eyes_look(&who, 1, pair.left.view(), pair.right.view()).meets_behind);
    ck_assert(eyes_look(&who, 2, pair.right.view(), pair.left.view()).meets_behind);
}
END_TEST

namespace
{
class last_reason : public marker_receiver
{
public:
    void publish(const reach_marker_t &marker) override
    {
        reason = marker.reason;
    }

    void show(const image_view &, const image_view &, const eyes &, const reach_marker_t &) override
    {
    }

    int reason = -1;
};
} // namespace

/* What the observer logs of a good second of pairs in which a ball swings before the eyes. */
struct second {
    bool swapped = false;
    bool upright = false; /* it swings up and down, else from side to side */
    int late = 0;         /* pairs by which the left eye's picture is late: here up to 100 px */
    bool frozen = false;  /* the left eye's picture stays what it was, under new stamps */
    bool grey = false;
    int64_t apart = 0; /* between the eyes' stamps; us */
    double ball_radius = 0;
    double vergence = 0.18;
};

static scene_eyes eyes_of(const second &what)
{
    scene_eyes eyes = scene_default_eyes();

    eyes.vergence = what.vergence;
    return eyes;
}

static std::vector<picture_pair> swing(const second &what)
{
    std::vector<picture_pair> pairs;
    std::mt19937_64 random(73);

    for (int i = 0; i < swing_pairs + most_late; i++) {
        scene ball = fixture_plain_scene();
        const double aside = 0.03 * std::sin(1.1 * i);
        ball.spheres[0].centre = {what.upright ? 0 : aside, what.upright ? aside : 0,
                                  0.55 + 0.1 * std::cos(0.9 * i)};
        pairs.push_back(fixture_draw(ball, eyes_of(what), random));
        if (what.grey)
            for (std::vector<uint8_t> *rgb : {&pairs.back().left.rgb, &pairs.back().right.rgb})
                for (size_t k = 0; k < rgb->size(); k++)
                    (*rgb)[k] = (*rgb)[k / 3 * 3 + 1];
    }
    return pairs;
}

static std::string logged(const second &what)
{
    static const char path[] = "test_vision_doubts.txt";
    const std::vector<picture_pair> pairs = swing(what);
    eyes_config config = fixture_config();
    last_reason said;
    std::stringstream text;

    config.most_apart = 20000;
    config.rig.ball_radius = what.ball_radius;
    config.rig.vergence = what.vergence;
    observer seer(config, 0, &said);
    ck_assert_ptr_nonnull(freopen(path, "w", stderr));
    log_open("test_vision_doubts", LOG_LEVEL_WARNING); /* a pipe it had opened for itself */
    for (int i = 0; i < swing_pairs; i++) {
        const picture &left = pairs[what.frozen ? 0 : i + most_late - what.late].left;
        const picture &right = pairs[i + most_late].right;
        incoming_pair pair;
        pair.waited = 0;
        pair.images.utime = 1000000 + i * swing_period;
        pair.images.left = fixture_encoded(what.swapped ? right : left);
        pair.images.right = fixture_encoded(what.swapped ? left : right);
        pair.images.left.utime = pair.images.utime;
        pair.images.right.utime = pair.images.utime + what.apart;
        seer.take(pair);
    }
    fflush(stderr);
    text << std::ifstream(path).rdbuf();
    unlink(path);
    return text.str();
}

/* Whether this is said, and that all is well without it. */
static bool says(const second &what, const char *part)
{
    const std::string text = logged(what);

    printf("%s\n", text.c_str());
    return text.find(part) != std::string::npos;
}

START_TEST(good_pairs_are_not_doubted)
{
    second known;

    known.ball_radius = 0.025;
    ck_assert_str_eq(logged({}).c_str(), "");
    ck_assert_str_eq(logged(known).c_str(), "");
}
END_TEST

START_TEST(swapped_eyes_are_noticed_within_a_second)
{
    second unknown;
    second known;
    second parallel;

    unknown.swapped = known.swapped = parallel.swapped = true;
    known.ball_radius = 0.025;
    parallel.vergence = 0;
    ck_assert(says(unknown, "swapped"));
    ck_assert(says(known, "swapped"));
    ck_assert(says(parallel, "swapped"));
}
END_TEST

START_TEST(a_late_eye_is_noticed_within_a_second)
{
    second aside;
    second upright;
    second known;

    aside.late = upright.late = known.late = most_late;
    upright.upright = true;
    known.ball_radius = 0.025;
    ck_assert(says(aside, "late"));
    ck_assert(says(upright, "late"));
    ck_assert(says(known, "late"));
}
END_TEST

START_TEST(frozen_grey_and_apart_are_noticed_within_a_second)
{
    second frozen;
    second grey;
    second apart;

    frozen.frozen = true;
    grey.grey = true;
    apart.apart = 40000;
    ck_assert(says(frozen, "left eye's pictures do not change"));
    ck_assert(says(grey, "no colour"));
    ck_assert(says(apart, "eyes.most_apart"));
}
END_TEST

START_TEST(pictures_of_two_exposures_are_no_pair)
{
    std::mt19937_64 random(72);
    const picture_pair pair = fixture_draw(fixture_plain_scene(), scene_default_eyes(), random);
    const std::vector<uint8_t> message = fixture_message(5000000, pair, 0);
    eyes_config config = fixture_config();
    last_reason said;

    config.most_apart = 20000;
    for (int64_t apart : {0, 15000, 40000}) {
        observer seer(config, 0, &said);
        incoming_pair incoming;
        incoming.waited = 0;
        ck_assert_ptr_null(image_message_parse(message.data(), message.size(), &incoming.images));
        incoming.images.left.utime = 5000000;
        incoming.images.right.utime = 5000000 + apart;
        seer.take(incoming);
        ck_assert_int_eq(said.reason, apart > 20000 ? STEREO_UNUSABLE : STEREO_SEEN);
    }
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        what_cannot_be_is_said_within_a_second,
        swapped_parallel_eyes_meet_behind,
        good_pairs_are_not_doubted,
        swapped_eyes_are_noticed_within_a_second,
        a_late_eye_is_noticed_within_a_second,
        frozen_grey_and_apart_are_noticed_within_a_second,
        pictures_of_two_exposures_are_no_pair,
    };

    log_open("test_vision_doubts", LOG_LEVEL_WARNING);
    return SUITE_RUN("vision doubts", tests);
}
