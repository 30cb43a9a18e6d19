/* Pairs in a row: windows, repetitions, lost and late pairs, unusable pictures, other formats. */
#include <cmath>
#include <cstdio>

#include "common/bus/open.h"
#include "common/program/log.h"
#include "fixture.h"
#include "vision/answers/observer.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int64_t period = 33000; /* us */
static const int n_pairs = 8;

namespace
{
class collector : public marker_receiver
{
public:
    void publish(const reach_marker_t &marker) override
    {
        markers.push_back(marker);
    }

    void show(const image_view &, const image_view &, const eyes &, const reach_marker_t &) override
    {
        shown++;
    }

    std::vector<reach_marker_t> markers;
    int shown = 0;
};
} // namespace

/* Drawn once, before Check forks a process for each test. */
static std::vector<picture_pair> pairs;

/* A ball that moves by some 10 px a frame. */
static void draw_motion()
{
    std::mt19937_64 random(31);
    scene what = fixture_plain_scene();

    for (int i = 0; i < n_pairs; i++) {
        what.spheres[0].centre.x = -0.03 + 0.004 * i;
        what.spheres[0].centre.y = 0.02 * std::sin(0.5 * i);
        pairs.push_back(fixture_draw(what, scene_default_eyes(), random));
    }
}

static stereo_marker look(eyes *who, int64_t utime, const picture_pair &pair)
{
    return eyes_look(who, utime, pair.left.view(), pair.right.view());
}

static void send(observer *seer, const std::vector<uint8_t> &message, int64_t waited)
{
    incoming_pair pair;

    pair.waited = waited;
    ck_assert_ptr_null(image_message_parse(message.data(), message.size(), &pair.images));
    seer->take(pair);
}

/* The bytes that go over the bus. */
static std::vector<uint8_t> bytes_of(const reach_marker_t &marker)
{
    std::vector<uint8_t> bytes(static_cast<size_t>(reach_marker_t_encoded_size(&marker)));

    reach_marker_t_encode(bytes.data(), 0, static_cast<int>(bytes.size()), &marker);
    return bytes;
}

/* Apart from the time it took, which no run repeats. */
static bool same(reach_marker_t a, reach_marker_t b)
{
    a.compute_us = b.compute_us = 0;
    return bytes_of(a) == bytes_of(b);
}

START_TEST(windows_and_whole_pictures_agree)
{
    eyes_config config = fixture_config();
    time_histogram times;
    eyes by_window;
    eyes by_whole;

    eyes_init(&by_window, config);
    config.recheck = 0;
    eyes_init(&by_whole, config);
    for (int i = 0; i < n_pairs; i++) {
        const int64_t utime = (i + 1) * period;
        const double start = statistics_thread_us();
        const stereo_marker a = look(&by_window, utime, pairs[i]);
        if (i > 0)
            time_histogram_add(&times, statistics_thread_us() - start);
        const stereo_marker b = look(&by_whole, utime, pairs[i]);
        ck_assert_int_eq(by_window.used_window, i > 0);
        ck_assert_int_eq(by_whole.used_window, 0);
        ck_assert_int_eq(a.reason, STEREO_SEEN);
        ck_assert_int_eq(b.reason, STEREO_SEEN);
        ck_assert_double_eq_tol(a.u_right, b.u_right, 0.03);
        ck_assert_double_eq_tol(a.v_right, b.v_right, 0.03);
        ck_assert_double_eq_tol(a.disparity, b.disparity, 0.03);
    }
    printf("windows: %.0f us of processor time a pair at the median\n",
           time_histogram_quantile(times, 0.5));
}
END_TEST

START_TEST(a_ball_that_jumps_is_found_again)
{
    const scene_eyes rig = scene_default_eyes();
    std::mt19937_64 random(32);
    scene what = fixture_plain_scene();
    eyes who;

    eyes_init(&who, fixture_config());
    look(&who, period, fixture_draw(what, rig, random));
    what.spheres[0].centre = {-0.06, 0.05, 0.6};
    const stereo_marker marker = look(&who, 2 * period, fixture_draw(what, rig, random));
    ck_assert_int_eq(marker.reason, STEREO_SEEN);
    ck_assert(!who.used_window);
    ck_assert_double_eq_tol(marker.u_right, fixture_truth_of(what, rig).u_right, 0.15);
}
END_TEST

START_TEST(whole_pictures_are_looked_at_now_and_then)
{
    eyes_config config = fixture_config();
    eyes who;

    config.recheck = 2;
    eyes_init(&who, config);
    for (int i = 0; i < 7; i++) {
        look(&who, (i + 1) * period, pairs[0]);
        ck_assert_int_eq(who.used_window, i % 3 != 0);
    }
}
END_TEST

START_TEST(late_pairs_leave_the_memory_alone)
{
    eyes disturbed;
    eyes calm;

    eyes_init(&disturbed, fixture_config());
    eyes_init(&calm, fixture_config());
    for (int i = 1; i < n_pairs; i++) {
        const stereo_marker a = look(&disturbed, (i + 1) * period, pairs[i]);
        const stereo_marker late = look(&disturbed, i * period, pairs[i - 1]);
        const stereo_marker b = look(&calm, (i + 1) * period, pairs[i]);
        ck_assert_int_eq(late.reason, STEREO_SEEN);
        ck_assert_double_eq(a.u_right, b.u_right);
        ck_assert_double_eq(a.v_right, b.v_right);
        ck_assert_double_eq(a.disparity, b.disparity);
    }
}
END_TEST

START_TEST(a_clock_set_back_starts_anew)
{
    eyes who;

    eyes_init(&who, fixture_config());
    look(&who, 100000000, pairs[0]);
    look(&who, 1000000, pairs[0]);
    ck_assert(!who.used_window);
    look(&who, 1000000 + period, pairs[1]);
    ck_assert(who.used_window);
}
END_TEST

START_TEST(the_same_pairs_give_the_same_markers)
{
    collector first;
    collector second;
    observer a(fixture_config(), 0, &first);
    observer b(fixture_config(), 0, &second);

    for (int i = 0; i < n_pairs; i++) {
        const std::vector<uint8_t> message = fixture_message((i + 1) * period, pairs[i], 0);
        send(&a, message, 0);
        send(&b, message, 0);
        /* Half of them again: the answer stays, and what follows is the same. */
        if (i % 2)
            send(&b, message, 0);
    }
    ck_assert_uint_eq(first.markers.size(), n_pairs);
    ck_assert_uint_eq(second.markers.size(), n_pairs + n_pairs / 2);
    for (int i = 0, j = 0; i < n_pairs; i++, j++) {
        ck_assert(same(first.markers[i], second.markers[j]));
        ck_assert_int_eq(first.markers[i].seq, i + 1);
        if (i % 2) {
            j++;
            ck_assert(bytes_of(second.markers[j - 1]) == bytes_of(second.markers[j]));
        }
    }
    ck_assert_int_eq(b.counts().repeated, n_pairs / 2);
    ck_assert_int_eq(second.shown, n_pairs);
}
END_TEST

START_TEST(new_pictures_under_an_old_stamp_are_looked_at)
{
    collector markers;
    observer seer(fixture_config(), 0, &markers);

    send(&seer, fixture_message(period, pairs[0], 0), 0);
    send(&seer, fixture_message(period, pairs[n_pairs - 1], 0), 0);
    ck_assert_double_gt(std::fabs(markers.markers[0].u_right - markers.markers[1].u_right), 20);
    ck_assert_int_eq(seer.counts().repeated, 0);
}
END_TEST

START_TEST(jpeg_and_raw_agree)
{
    collector markers;

    for (int quality : {0, 95}) {
        observer seer(fixture_config(), 0, &markers);
        send(&seer, fixture_message(period, pairs[2], quality), 0);
    }
    ck_assert_int_eq(markers.markers[1].seen, 1);
    ck_assert_double_eq_tol(markers.markers[0].u_right, markers.markers[1].u_right, 0.1);
    ck_assert_double_eq_tol(markers.markers[0].v_right, markers.markers[1].v_right, 0.1);
    ck_assert_double_eq_tol(markers.markers[0].disparity, markers.markers[1].disparity, 0.1);
}
END_TEST

START_TEST(red_and_blue_are_told_apart)
{
    picture_pair pair = pairs[0];
    const image_view rgb = pair.right.view();
    image_view bgr_left = pair.left.view();
    image_view bgr_right = rgb;
    eyes who;

    eyes_init(&who, fixture_config());
    const stereo_marker a = eyes_look(&who, 2000, pair.left.view(), rgb);
    for (std::vector<uint8_t> *pixels : {&pair.left.rgb, &pair.right.rgb})
        for (size_t i = 0; i < pixels->size(); i += 3)
            std::swap((*pixels)[i], (*pixels)[i + 2]);
    bgr_left.order = bgr_right.order = PIXEL_BGR;
    const stereo_marker b = eyes_look(&who, 1000, bgr_left, bgr_right);
    ck_assert_int_eq(b.reason, STEREO_SEEN);
    /* Sums of three channels in another order round differently. */
    ck_assert_double_eq_tol(a.u_right, b.u_right, 1e-3);
}
END_TEST

/* Sends a pair whose right image has other bytes, and returns the reason. */
static int reason_of(const std::vector<uint8_t> &bytes, int32_t format, int width, int height)
{
    collector markers;
    observer seer(fixture_config(), 0, &markers);
    incoming_pair pair;

    pair.waited = 0;
    pair.images.utime = 1000000;
    pair.images.right = {bytes.data(),
                         bytes.size(),
                         width,
                         height,
                         format == PIXEL_FORMAT_MJPEG ? 0 : static_cast<size_t>(3 * width),
                         format};
    pair.images.left = pair.images.right;
    seer.take(pair);
    ck_assert_uint_eq(markers.markers.size(), 1);
    ck_assert_int_eq(markers.markers[0].utime, 1000000);
    ck_assert_int_eq(seer.counts().reasons[markers.markers[0].reason], 1);
    return markers.markers[0].reason;
}

START_TEST(unusable_pictures_are_said_to_be_so)
{
    const picture one = pairs[0].right;
    picture small = one;
    std::vector<uint8_t> jpeg = fixture_jpeg(one, 90);

    small.width = 320;
    ck_assert_int_ne(reason_of(jpeg, PIXEL_FORMAT_MJPEG, 640, 480), STEREO_UNUSABLE);
    ck_assert_int_eq(reason_of(one.rgb, PIXEL_FORMAT_GRAY, 640, 480), STEREO_UNUSABLE);
    ck_assert_int_eq(reason_of(one.rgb, PIXEL_FORMAT_RGB, 320, 480), STEREO_UNUSABLE);
    /* A JPEG that is larger or smaller than the message says. */
    ck_assert_int_eq(reason_of(fixture_jpeg(small, 90), PIXEL_FORMAT_MJPEG, 640, 480),
                     STEREO_UNUSABLE);
    jpeg.resize(jpeg.size() / 2);
    ck_assert_int_eq(reason_of(jpeg, PIXEL_FORMAT_MJPEG, 640, 480), STEREO_UNUSABLE);
    jpeg.resize(3);
    ck_assert_int_eq(reason_of(jpeg, PIXEL_FORMAT_MJPEG, 640, 480), STEREO_UNUSABLE);
}
END_TEST

START_TEST(damaged_jpeg_never_ends_the_program)
{
    std::mt19937_64 random(fixture_seed(33));
    const std::vector<uint8_t> good = fixture_jpeg(pairs[0].right, 60);

    for (int i = 0; i < 60; i++) {
        std::vector<uint8_t> bytes = good;
        const size_t range = i % 2 ? bytes.size() : 700; /* headers are worth more than data */
        for (int j = 0; j < 4; j++)
            bytes[random() % range] = static_cast<uint8_t>(random());
        if (i % 5 == 0)
            bytes.resize(1 + random() % bytes.size());
        reason_of(bytes, PIXEL_FORMAT_MJPEG, 640, 480);
    }
}
END_TEST

START_TEST(only_live_pairs_are_passed_over)
{
    collector markers;
    observer seer(fixture_config(), 50000, &markers);

    send(&seer, fixture_message(bus_utime(), pairs[0], 0), 60000);
    ck_assert_int_eq(seer.counts().dropped, 1);
    ck_assert_uint_eq(markers.markers.size(), 0);
    send(&seer, fixture_message(bus_utime(), pairs[0], 0), 40000);
    send(&seer, fixture_message(1000000, pairs[0], 0), 60000);
    ck_assert_uint_eq(markers.markers.size(), 2);
    ck_assert_int_eq(markers.markers[0].seq, 2);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        windows_and_whole_pictures_agree,
        a_ball_that_jumps_is_found_again,
        whole_pictures_are_looked_at_now_and_then,
        late_pairs_leave_the_memory_alone,
        a_clock_set_back_starts_anew,
        the_same_pairs_give_the_same_markers,
        new_pictures_under_an_old_stamp_are_looked_at,
        jpeg_and_raw_agree,
        red_and_blue_are_told_apart,
        unusable_pictures_are_said_to_be_so,
        damaged_jpeg_never_ends_the_program,
        only_live_pairs_are_passed_over,
    };

    log_open("test_vision_sequence", LOG_LEVEL_ERROR);
    draw_motion();
    return SUITE_RUN("vision sequence", tests);
}
