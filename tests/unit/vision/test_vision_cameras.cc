/* reach-vision --cameras with cameras that are none: v4l2_stand_in.c answers for them. */
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>

#include "fixture.h"
#include "program.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const char *const left = "/dev/stand-in-left";
static const char *const right = "/dev/stand-in-right";

static bool has(const std::string &text, const char *part)
{
    return text.find(part) != std::string::npos;
}

static void draw_eyes()
{
    std::mt19937_64 random(91);
    const picture_pair pair = fixture_draw(fixture_plain_scene(), scene_default_eyes(), random);

    for (const bool is_left : {true, false}) {
        const std::vector<uint8_t> bytes = fixture_jpeg(is_left ? pair.left : pair.right, 95);
        std::ofstream(is_left ? "left.jpg" : "right.jpg", std::ios::binary)
            .write(reinterpret_cast<const char *>(bytes.data()), static_cast<long>(bytes.size()));
    }
}

static std::string asked(const char *path)
{
    std::string line;
    std::ifstream in(path);

    std::getline(in, line);
    unlink(path);
    return line;
}

static program_end run(std::vector<std::string> words, std::vector<std::string> environment)
{
    const std::string here(REACH_STAND_IN_LIBRARY);

    draw_eyes();
    words.insert(words.end(), {"--set", "eyes.vergence=10.3132", "--set", "ball.radius=0.025"});
    environment.insert(environment.end(), {"LD_PRELOAD=" + here, "REACH_STAND_IN=.",
                                           "ASAN_OPTIONS=verify_asan_link_order=0:detect_leaks=0"});
    const program_end end = program_run(words, environment);
    unlink("left.jpg");
    unlink("right.jpg");
    return end;
}

START_TEST(cameras_are_asked_and_tell)
{
    const char *const stats = "test_vision_cameras.json";
    const program_end end = run({"--cameras", left, right, "--stats", stats}, {});
    const std::string counts = asked(stats);

    ck_assert_msg(end.code == 1, "%s", end.logged.c_str()); /* they were unplugged at last */
    ck_assert_str_eq(asked("left.asked").c_str(), "640x480 MJPG 30");
    ck_assert_str_eq(asked("right.asked").c_str(), "640x480 MJPG 30");
    ck_assert_msg(has(end.logged, "/dev/stand-in-left: MJPG, 640 x 480 pixels, 30 pictures/s"),
                  "%s", end.logged.c_str());
    ck_assert(has(end.logged, "/dev/stand-in-right: MJPG, 640 x 480 pixels, 30 pictures/s"));
    ck_assert_msg(has(end.logged, "v4l2-ctl -d /dev/stand-in-left -c white_balance_automatic=0 -c "
                                  "auto_exposure=1"),
                  "%s", end.logged.c_str());
    ck_assert(has(end.logged, "a camera stopped sending"));
    int pairs = 0;
    int seen = 0;
    ck_assert_int_eq(sscanf(counts.c_str(), "{\"pairs\": %d, %*[^[][%d,", &pairs, &seen), 2);
    ck_assert_int_ge(pairs, 15); /* opening a camera may cost one of its 20 pictures */
    ck_assert_int_eq(seen, pairs);
}
END_TEST

START_TEST(another_size_is_refused_by_name)
{
    const program_end end = run({"--cameras", left, right}, {"REACH_STAND_IN_SIZE=1280x720"});

    ck_assert_int_eq(end.code, 1);
    ck_assert_msg(has(end.logged, "/dev/stand-in-left: gives 1280 x 720 pixels, not 640 x 480"),
                  "%s", end.logged.c_str());
    ck_assert(has(end.logged, "camera.width"));
}
END_TEST

START_TEST(another_format_and_rate_are_told)
{
    const program_end end =
        run({"--cameras", left, right, "--set", "camera.rate=25"},
            {"REACH_STAND_IN_FORMAT=YUYV", "REACH_STAND_IN_RATE=10", "REACH_STAND_IN_FRAMES=2"});

    ck_assert_int_eq(end.code, 1);
    ck_assert_msg(has(end.logged, "/dev/stand-in-left: sends YUYV, not MJPG"), "%s",
                  end.logged.c_str());
    ck_assert(has(end.logged, "/dev/stand-in-left: 10 pictures/s instead of camera.rate, 25"));
    unlink("left.asked");
    unlink("right.asked");
}
END_TEST

/* One camera is enough to learn a colour from. */
START_TEST(a_camera_tells_the_colour)
{
    const program_end end = run({"--learn-colour", right, "--at", "372,167"}, {});

    ck_assert_msg(end.code == 0, "%s", end.logged.c_str());
    ck_assert_msg(has(end.printed, "ball: {hue: 12"), "%s", end.printed.c_str());
    ck_assert(has(end.logged, "auto_exposure=1"));
    unlink("right.asked");
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        cameras_are_asked_and_tell,
        another_size_is_refused_by_name,
        another_format_and_rate_are_told,
        a_camera_tells_the_colour,
    };

    return SUITE_RUN("vision cameras", tests);
}
