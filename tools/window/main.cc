/* reach-window: pictures from standard input in a window or as a video; what the user does in the
 * window goes to standard output, a line each: "key 113", "click 10 20". Python draws the pictures
 * and has no OpenCV of its own: the one that the build has serves both. */
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <cstdio>
#include <vector>

#include "common/logs/event_log.h"
#include "common/options/command_line.h"
#include "common/program/log.h"

namespace
{

const char title[] = "reachd";

struct Settings {
    const char *video = nullptr;
    int width = 1280, height = 720, rate = 25;
    bool window = true;
};

const argument_row rows[] = {
    ARGUMENT_INT("width", "N", Settings, width, 16, 8192, "of a picture, px (default 1280)"),
    ARGUMENT_INT("height", "N", Settings, height, 16, 8192, "of a picture, px (default 720)"),
    ARGUMENT_TEXT("video", 0, "FILE", Settings, video, "write the pictures as a video (mp4)"),
    ARGUMENT_INT("rate", "N", Settings, rate, 1, 240,
                 "pictures a second of the video (default 25)"),
    ARGUMENT_OFF("no-window", Settings, window, "open no window"),
    ARGUMENT_END,
};

const command_line line = {
    "reach-window",
    "reach-window [options]",
    "Shows pictures from the standard input, each width x height pixels of three bytes (red, "
    "green, "
    "blue), and prints the keys and clicks that come meanwhile.",
    rows,
    "0 the input ended or the window was closed, 1 there is no display or no place for the video",
    nullptr,
    nullptr,
    nullptr};

void on_mouse(int event, int x, int y, int, void *)
{
    if (event == cv::EVENT_LBUTTONDOWN) {
        printf("click %d %d\n", x, y);
        fflush(stdout);
    }
}

/* Shows a picture and serves the window's events. Returns false when the window was closed. */
bool show(const cv::Mat &picture)
{
    cv::imshow(title, picture);
    for (int key = cv::pollKey(); key >= 0; key = cv::pollKey()) {
        printf("key %d\n", key & 0xff);
        fflush(stdout);
    }
    return cv::getWindowProperty(title, cv::WND_PROP_VISIBLE) >= 1;
}

/* H.264 where OpenCV's FFmpeg can write it, which every browser plays, otherwise MPEG-4. */
bool open_video(const Settings &settings, cv::VideoWriter *video)
{
    const cv::Size size(settings.width, settings.height);

    for (const char *codec : {"avc1", "mp4v"})
        if (video->open(settings.video, cv::CAP_FFMPEG,
                        cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]),
                        settings.rate, size))
            return true;
    return false;
}

int serve(const Settings &settings)
{
    cv::VideoWriter video;
    std::vector<uint8_t> bytes(static_cast<size_t>(settings.width) *
                               static_cast<size_t>(settings.height) * 3);
    const cv::Mat rgb(settings.height, settings.width, CV_8UC3, bytes.data());
    cv::Mat picture;

    if (settings.video && event_log_begins(settings.video)) {
        log_error("%s: is a log, and is not overwritten", settings.video);
        return 1;
    }
    if (settings.video && !open_video(settings, &video)) {
        log_error("%s: no video can be written there", settings.video);
        return 1;
    }
    if (settings.window) {
        cv::namedWindow(title, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
        cv::setMouseCallback(title, on_mouse);
    }
    while (fread(bytes.data(), bytes.size(), 1, stdin) == 1) {
        cv::cvtColor(rgb, picture, cv::COLOR_RGB2BGR);
        if (settings.video)
            video.write(picture);
        if (settings.window && !show(picture))
            break;
    }
    return 0;
}

} // namespace

int main(int argc, char **argv)
{
    Settings settings;
    int status = command_line_parse(&line, argc, argv, &settings);

    if (status >= 0)
        return status;
    log_open("reach-window", LOG_LEVEL_INFO);
    try {
        return serve(settings);
    } catch (const cv::Exception &error) {
        log_error("%s", error.err.c_str());
        return 1;
    }
}
