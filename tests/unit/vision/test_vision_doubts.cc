/* Pairs that cannot be what they should: swapped, frozen, late, stamped apart. */
#include <cstring>

#include "common/program/log.h"
#include "fixture.h"
#include "vision/answers/doubts.h"
#include "vision/answers/observer.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int64_t period = 33000; /* us */

/* What is said within a good second of pairs; each byte changes every pair unless it is frozen. */
static const char *say(bool left_frozen, bool right_frozen, const stereo_marker &marker)
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
        said = doubts_add(&all, pair, marker);
    }
    return said;
}

START_TEST(what_cannot_be_is_said_within_a_second)
{
    stereo_marker good;
    stereo_marker behind;
    stereo_marker heights;

    good.reason = STEREO_SEEN;
    behind.reason = STEREO_SEEN;
    behind.meets_behind = true;
    heights.reason = STEREO_HEIGHTS_DIFFER;
    ck_assert_ptr_null(say(false, false, good));
    ck_assert_ptr_null(say(true, true, good)); /* a simulated robot at rest */
    ck_assert_ptr_nonnull(strstr(say(true, false, good), "left eye"));
    ck_assert_ptr_nonnull(strstr(say(false, true, good), "right eye"));
    ck_assert_ptr_nonnull(strstr(say(false, false, behind), "swapped"));
    ck_assert_ptr_nonnull(strstr(say(false, false, heights), "late"));
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
        pictures_of_two_exposures_are_no_pair,
    };

    log_open("test_vision_doubts", LOG_LEVEL_ERROR);
    return SUITE_RUN("vision doubts", tests);
}
