#include <opencv2/videoio.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "common/bus/open.h"
#include "common/program/log.h"
#include "vision/pictures/camera_setup.h"
#include "vision/pictures/image_file.h"
#include "vision/pictures/source.h"

static const double default_rate = 30; /* frames/s, for files that do not say */
static const int64_t first_stamp = 1000000;

namespace
{
bool to_encoded(const cv::Mat &frame, encoded_image *image)
{
    if (frame.empty() || frame.type() != CV_8UC3)
        return false;
    image->data = frame.data;
    image->stride = frame.step;
    image->size = frame.step * static_cast<size_t>(frame.rows);
    image->width = frame.cols;
    image->height = frame.rows;
    image->format = PIXEL_FORMAT_BGR;
    return true;
}

/* Two captures that are read side by side, or one for both eyes; what differs is the stamp and the
 * pace. */
class capture_source : public source
{
public:
    explicit capture_source(pair_receiver *receiver) : receiver_(receiver) {}

    bool open(const char *left, const char *right, int backend, char *error, size_t error_size)
    {
        return open_one(&left_, left, backend, error, error_size) &&
               (!right || open_one(&right_, right, backend, error, error_size));
    }

protected:
    bool grab()
    {
        const bool left = left_.grab();
        const bool right = !right_.isOpened() || right_.grab();
        return left && right;
    }

    void hand_over(int64_t utime)
    {
        incoming_pair pair;

        pair.images.utime = utime;
        pair.waited = 0;
        const cv::Mat &other = right_.isOpened() ? right_frame_ : left_frame_;
        if (left_.retrieve(left_frame_) && (!right_.isOpened() || right_.retrieve(right_frame_)) &&
            to_encoded(left_frame_, &pair.images.left) && to_encoded(other, &pair.images.right))
            receiver_->take(pair);
        else
            receiver_->refuse("a frame is not 8-bit colour");
    }

    cv::VideoCapture left_;
    cv::VideoCapture right_;

private:
    static bool open_one(cv::VideoCapture *capture, const char *name, int backend, char *error,
                         size_t error_size)
    {
        if (capture->open(name, backend))
            return true;
        snprintf(error, error_size, "%s cannot be opened as %s; check the name and its permissions",
                 name, backend == cv::CAP_V4L2 ? "a V4L2 camera" : "a video");
        return false;
    }

    pair_receiver *receiver_;
    cv::Mat left_frame_;
    cv::Mat right_frame_;
};

class camera_source : public capture_source
{
public:
    using capture_source::capture_source;

    bool ask(const char *left, const char *right, const camera &eye, double rate, char *error,
             size_t error_size)
    {
        if (!camera_ask(&left_, left, eye, rate, error, error_size) ||
            (right && !camera_ask(&right_, right, eye, rate, error, error_size)))
            return false;
        camera_warn_of_automatics(left);
        if (right)
            camera_warn_of_automatics(right);
        return true;
    }

    source_state poll(int) override
    {
        const int64_t before = bus_utime();

        if (!grab()) {
            log_error("a camera stopped sending; check its cable");
            return SOURCE_FAILED;
        }
        hand_over(before + (bus_utime() - before) / 2);
        return SOURCE_OPEN;
    }
};

class video_source : public capture_source
{
public:
    using capture_source::capture_source;

    void set_rate(double rate)
    {
        const double own = left_.get(cv::CAP_PROP_FPS);

        period_ = 1e6 / (own > 0 && std::isfinite(own) ? own : default_rate);
        pace_ = rate > 0 ? static_cast<int64_t>(1e6 / rate) : 0;
        due_ = bus_monotonic_us();
    }

    source_state poll(int milliseconds) override
    {
        if (!wait_until_due(milliseconds))
            return SOURCE_OPEN;
        if (!grab())
            return SOURCE_ENDED;
        hand_over(first_stamp + static_cast<int64_t>(std::llround(period_ * frames_)));
        frames_++;
        due_ += pace_;
        return SOURCE_OPEN;
    }

private:
    bool wait_until_due(int milliseconds) const
    {
        const int64_t left = pace_ > 0 ? due_ - bus_monotonic_us() : 0;
        const int64_t nap = left < milliseconds * 1000 ? left : milliseconds * 1000;
        const timespec duration = {0, static_cast<long>(nap > 0 ? nap * 1000 : 0)};

        if (nap > 0)
            nanosleep(&duration, nullptr);
        return left <= nap;
    }

    double period_ = 1e6 / default_rate; /* us between stamps */
    int64_t pace_ = 0;                   /* us between pairs, 0 = none */
    int64_t due_ = 0;                    /* monotonic us */
    int64_t frames_ = 0;
};

class picture_source : public source
{
public:
    picture_source(const cv::Mat &picture, pair_receiver *receiver)
        : picture_(picture), receiver_(receiver)
    {
    }

    source_state poll(int) override
    {
        incoming_pair pair;

        pair.images.utime = first_stamp;
        pair.waited = 0;
        if (to_encoded(picture_, &pair.images.left) && to_encoded(picture_, &pair.images.right))
            receiver_->take(pair);
        return SOURCE_ENDED;
    }

private:
    cv::Mat picture_;
    pair_receiver *receiver_;
};
} // namespace

std::unique_ptr<source> source_one(const char *name, const camera &eye, double rate,
                                   pair_receiver *receiver, char *error, size_t error_size)
{
    if (strncmp(name, "/dev/", 5) == 0)
        return source_cameras(name, nullptr, eye, rate, receiver, error, error_size);
    const cv::Mat picture = image_file_read(name);
    if (!picture.empty())
        return std::make_unique<picture_source>(picture, receiver);
    return source_videos(name, nullptr, 0, receiver, error, error_size);
}

std::unique_ptr<source> source_cameras(const char *left, const char *right, const camera &eye,
                                       double rate, pair_receiver *receiver, char *error,
                                       size_t error_size)
{
    std::unique_ptr<camera_source> made(new camera_source(receiver));

    if (!made->open(left, right, cv::CAP_V4L2, error, error_size) ||
        !made->ask(left, right, eye, rate, error, error_size))
        return nullptr;
    return made;
}

std::unique_ptr<source> source_videos(const char *left, const char *right, double rate,
                                      pair_receiver *receiver, char *error, size_t error_size)
{
    std::unique_ptr<video_source> made(new video_source(receiver));

    if (!made->open(left, right, cv::CAP_ANY, error, error_size))
        return nullptr;
    made->set_rate(rate);
    return made;
}
