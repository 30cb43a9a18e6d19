/* reach-vision --calibrate, from a log and from two videos to the YAML and the picture. */
#include <lcm/eventlog.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <unistd.h>

#include <cstring>

#include "crooked.h"
#include "fixture.h"
#include "program.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int n_pairs = 60;
static const int64_t period = 100000; /* us */
static const char log_path[] = "test_vision_calibrate.lcmlog";
static const char left_path[] = "test_vision_calibrate_left.avi";
static const char right_path[] = "test_vision_calibrate_right.avi";
static const char rig_path[] = "test_vision_calibrate.yaml";
static const char picture_path[] = "test_vision_calibrate.png";

static cv::Mat bgr_of(const std::vector<uint8_t> &jpeg)
{
    return cv::imdecode(jpeg, cv::IMREAD_COLOR);
}

/* A moved ball before crooked eyes, as a log and as two videos. */
static void record(std::mt19937_64 &random)
{
    lcm_eventlog_t *log = lcm_eventlog_create(log_path, "w");
    cv::VideoWriter left;
    cv::VideoWriter right;
    char channel[] = "STEREO_IMAGES";

    for (cv::VideoWriter *video : {&left, &right})
        ck_assert(video->open(video == &left ? left_path : right_path,
                              cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, {640, 480}));
    for (int i = 0; i < n_pairs; i++) {
        const picture_pair pair = fixture_draw(scene_random(random), crooked_eyes(), random);
        std::vector<uint8_t> message = fixture_message(1000000 + period * i, pair, 97);
        lcm_eventlog_event_t event = {i,
                                      1000000 + period * i,
                                      static_cast<int32_t>(strlen(channel)),
                                      static_cast<int32_t>(message.size()),
                                      channel,
                                      message.data()};
        ck_assert_int_eq(lcm_eventlog_write_event(log, &event), 0);
        left.write(bgr_of(fixture_jpeg(pair.left, 100)));
        right.write(bgr_of(fixture_jpeg(pair.right, 100)));
    }
    lcm_eventlog_destroy(log);
}

static program_end calibrate(std::vector<std::string> words)
{
    words.insert(words.end(),
                 {"--calibrate", rig_path, "--draw", picture_path, "--set", "eyes.vergence=10.3132",
                  "--set", "ball.hue=125", "--set", "ball.saturation_min=0.35"});
    return program_run(words, {});
}

/* The rig in the file holds what is asked of one, and the picture shows both eyes. */
static void check(const program_end &end, std::mt19937_64 &random)
{
    ck_assert_msg(end.code == 0, "%s", end.logged.c_str());
    ck_assert_msg(end.logged.find("sightings agree") != std::string::npos, "%s",
                  end.logged.c_str());
    ck_assert_int_eq(crooked_seen(crooked_load(rig_path), random), CROOKED_CHECKS);
    const cv::Mat drawn = cv::imread(picture_path, cv::IMREAD_COLOR);
    ck_assert_int_eq(drawn.cols, 1280);
    ck_assert_int_eq(drawn.rows, 480);
    cv::Mat green;
    cv::inRange(drawn, cv::Scalar(0, 200, 0), cv::Scalar(0, 200, 0), green);
    ck_assert_int_gt(cv::countNonZero(green), 200);
    unlink(rig_path);
    unlink(picture_path);
}

START_TEST(from_recorded_pairs_to_the_rig)
{
    std::mt19937_64 random(fixture_seed(95));

    record(random);
    check(calibrate({"--log", log_path}), random);
    check(calibrate({"--videos", left_path, right_path}), random);
    const program_end colour = program_run({"--learn-colour", log_path}, {});
    ck_assert_msg(colour.code == 0, "%s", colour.logged.c_str());
    ck_assert_msg(colour.printed.find("ball: {hue: 12") != std::string::npos, "%s",
                  colour.printed.c_str());
    for (const char *path : {log_path, left_path, right_path})
        unlink(path);
}
END_TEST

START_TEST(what_cannot_be_used_is_said)
{
    const program_end none = calibrate({"--log", "no-such.lcmlog"});
    ck_assert_int_eq(none.code, 1);
    ck_assert(none.logged.find("no-such.lcmlog") != std::string::npos);

    std::mt19937_64 random(96);
    lcm_eventlog_destroy(lcm_eventlog_create(log_path, "w"));
    const program_end empty = calibrate({"--log", log_path});
    unlink(log_path);
    ck_assert_int_eq(empty.code, 1);
    ck_assert(access(rig_path, F_OK) != 0);
    ck_assert_int_eq(calibrate({"--log", log_path, "--bench", "a.png"}).code, 2);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        from_recorded_pairs_to_the_rig,
        what_cannot_be_used_is_said,
    };

    return suite_run("vision calibrate", tests, 2, 110);
}
