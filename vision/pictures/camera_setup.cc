#include "vision/pictures/camera_setup.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <string>

#include "common/program/log.h"

static const int motion_jpeg = cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
static const double rate_share = 0.95; /* of what was asked for: less is told */

/* The four letters of a pixel format. */
static std::string name_of(int format)
{
    std::string name;

    for (int shift = 0; shift < 32; shift += 8) {
        const int letter = format >> shift & 0xff;
        name += std::isprint(letter) ? static_cast<char>(letter) : '?';
    }
    return name;
}

static void complain(const char *path, const std::string &format, double got, double rate)
{
    if (format != "MJPG")
        log_warning("%s: sends %s, not MJPG: uncompressed pictures of two cameras can be more than "
                    "one USB carries",
                    path, format.c_str());
    if (rate > 0 && got > 0 && got < rate_share * rate)
        log_warning("%s: %.4g pictures/s instead of camera.rate, %.4g: more light or a smaller "
                    "picture may help; v4l2-ctl -d %s --list-formats-ext lists what it can",
                    path, got, rate, path);
}

bool camera_ask(cv::VideoCapture *capture, const char *path, const camera &eye, double rate,
                char *error, size_t error_size)
{
    capture->set(cv::CAP_PROP_FOURCC, motion_jpeg);
    capture->set(cv::CAP_PROP_FRAME_WIDTH, eye.width);
    capture->set(cv::CAP_PROP_FRAME_HEIGHT, eye.height);
    if (rate > 0)
        capture->set(cv::CAP_PROP_FPS, rate);
    /* The newest frame, not one from a queue that the driver keeps. */
    capture->set(cv::CAP_PROP_BUFFERSIZE, 1);

    const std::string format = name_of(static_cast<int>(capture->get(cv::CAP_PROP_FOURCC)));
    const int width = static_cast<int>(capture->get(cv::CAP_PROP_FRAME_WIDTH));
    const int height = static_cast<int>(capture->get(cv::CAP_PROP_FRAME_HEIGHT));
    const double got = capture->get(cv::CAP_PROP_FPS);
    if (width != eye.width || height != eye.height) {
        snprintf(error, error_size,
                 "%s: gives %d x %d pixels, not %d x %d: set camera.width and camera.height to a "
                 "size that it has (v4l2-ctl -d %s --list-formats-ext)",
                 path, width, height, eye.width, eye.height, path);
        return false;
    }
    log_info("%s: %s, %d x %d pixels, %.4g pictures/s", path, format.c_str(), width, height, got);
    complain(path, format, got, rate);
    return true;
}

/* The name by which v4l2-ctl knows a control: letters and digits, the rest becomes "_". */
static std::string control_name(const v4l2_queryctrl &control)
{
    std::string name;

    for (const unsigned char letter : control.name) {
        if (letter == 0)
            break;
        if (std::isalnum(letter))
            name += static_cast<char>(std::tolower(letter));
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    return name;
}

/* " -c NAME=VALUE" where the control is there and not at `locked`, else nothing. */
static std::string to_lock(int device, unsigned id, int locked)
{
    v4l2_queryctrl control = {};
    v4l2_control value = {};

    control.id = value.id = id;
    if (ioctl(device, VIDIOC_QUERYCTRL, &control) || control.flags & V4L2_CTRL_FLAG_DISABLED ||
        ioctl(device, VIDIOC_G_CTRL, &value) || value.value == locked)
        return "";
    return " -c " + control_name(control) + "=" + std::to_string(locked);
}

void camera_warn_of_automatics(const char *path)
{
    static const struct {
        unsigned id;
        int locked;
        const char *name;
    } automatics[] = {{V4L2_CID_AUTO_WHITE_BALANCE, 0, "white balance"},
                      {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, "exposure"},
                      {V4L2_CID_AUTOGAIN, 0, "gain"}};
    const int device = open(path, O_RDWR | O_NONBLOCK);
    std::string which;
    std::string command;

    if (device < 0)
        return;
    for (const auto &one : automatics) {
        const std::string lock = to_lock(device, one.id, one.locked);
        if (lock.empty())
            continue;
        which += (which.empty() ? "" : ", ") + std::string(one.name);
        command += lock;
    }
    close(device);
    if (!which.empty())
        log_warning("%s: automatic: %s; the ball's colour changes with that; lock it: v4l2-ctl -d "
                    "%s%s",
                    path, which.c_str(), path, command.c_str());
}
