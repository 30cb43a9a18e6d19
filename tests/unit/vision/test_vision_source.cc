/* Pairs from video files, and what is said when they are not there. */
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <unistd.h>

#include <cstring>
#include <string>

#include "fixture.h"
#include "vision/pictures/source.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int n_frames = 5;

namespace
{
class looker : public pair_receiver
{
public:
    looker()
    {
        eyes_init(&who, fixture_config());
    }

    void take(const incoming_pair &pair) override
    {
        const encoded_image &l = pair.images.left;
        const encoded_image &r = pair.images.right;
        const stereo_marker marker =
            eyes_look(&who, pair.images.utime, {l.data, l.width, l.height, l.stride, PIXEL_BGR},
                      {r.data, r.width, r.height, r.stride, PIXEL_BGR});
        stamps.push_back(pair.images.utime);
        seen += marker.reason == STEREO_SEEN;
        u_right = marker.u_right;
    }

    void refuse(const char *) override
    {
        refused++;
    }

    eyes who;
    std::vector<int64_t> stamps;
    int seen = 0;
    int refused = 0;
    double u_right = 0;
};
} // namespace

static void write_video(const std::string &path, const picture &still)
{
    const cv::Mat rgb(still.height, still.width, CV_8UC3, const_cast<uint8_t *>(still.rgb.data()));
    cv::VideoWriter video(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                          {still.width, still.height});
    cv::Mat bgr;

    ck_assert(video.isOpened());
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    for (int i = 0; i < n_frames; i++)
        video.write(bgr);
}

START_TEST(two_video_files_are_two_eyes)
{
    std::mt19937_64 random(41);
    const scene what = fixture_plain_scene();
    const picture_pair pair = fixture_draw(what, scene_default_eyes(), random);
    const std::string left = "test_vision_left.avi";
    const std::string right = "test_vision_right.avi";
    char error[256] = "";
    looker receiver;

    write_video(left, pair.left);
    write_video(right, pair.right);
    const std::unique_ptr<source> videos =
        source_videos(left.c_str(), right.c_str(), 0, &receiver, error, sizeof error);
    ck_assert_msg(videos != nullptr, "%s", error);
    while (videos->poll(100) == SOURCE_OPEN)
        ck_assert_uint_le(receiver.stamps.size(), n_frames);
    unlink(left.c_str());
    unlink(right.c_str());
    ck_assert_uint_eq(receiver.stamps.size(), n_frames);
    ck_assert_int_eq(receiver.stamps[0], 1000000);
    ck_assert_int_eq(receiver.stamps[4], 1160000);
    ck_assert_int_eq(receiver.seen, n_frames);
    ck_assert_double_eq_tol(receiver.u_right, fixture_truth_of(what, scene_default_eyes()).u_right,
                            0.3);
}
END_TEST

START_TEST(what_is_not_there_is_named)
{
    const camera eye = scene_default_eyes().left;
    char error[256] = "";
    looker receiver;

    ck_assert(!source_videos("no-such-left.avi", "b.avi", 0, &receiver, error, sizeof error));
    ck_assert_ptr_nonnull(strstr(error, "no-such-left.avi"));
    ck_assert(!source_cameras("/dev/no-such-camera", "/dev/null", eye, 30, &receiver, error,
                              sizeof error));
    ck_assert_ptr_nonnull(strstr(error, "/dev/no-such-camera"));
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        two_video_files_are_two_eyes,
        what_is_not_there_is_named,
    };

    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return SUITE_RUN("vision source", tests);
}
