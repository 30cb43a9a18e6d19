/* The eyes in a thread of their own: physics goes on while images are drawn, encoded and sent. */
#ifndef SIMROBOT_EYES_EYE_THREAD_H
#define SIMROBOT_EYES_EYE_THREAD_H

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "common/bus/open.h"
#include "simrobot/eyes/image_message.h"
#include "simrobot/eyes/renderer.h"
#include "simrobot/eyes/sensor.h"

namespace sim
{

/* One exposure of both eyes. */
struct EyeJob {
    Snapshot snapshot;
    int64_t utime;
    int64_t release; /* CLOCK_MONOTONIC us before which it must not go out; 0 = at once */
};

class EyeThread
{
public:
    /* Starts the thread. `may_drop`: when images come faster than they can be drawn, the oldest
     * that waits is dropped and counted (real time); else submit waits (lockstep).
     *   returns nullptr with one line in `error` when there is nothing to draw with. */
    static std::unique_ptr<EyeThread> create(const Config &config, uint64_t seed, lcm_t *lcm,
                                             bool may_drop, std::string *error);

    /* Finishes the images that wait, then ends the thread. */
    ~EyeThread();
    EyeThread(const EyeThread &) = delete;
    EyeThread &operator=(const EyeThread &) = delete;

    void submit(EyeJob job);

    /* Lockstep: a state went out with which the pair of this exposure is due; and that state was
     * answered. A pair goes out when the one before it was answered, or when it is due itself: so
     * many pairs never wait at vision that one is lost, and vision meets all in their order, which
     * its answers depend on in the last digits. */
    void due(int64_t utime);
    void answered(int64_t utime);

    /* Sends the pair of this exposure once more, if it is among the last few. */
    void publish_again(int64_t utime);

    int64_t dropped() const
    {
        return dropped_;
    }

private:
    struct Sent {
        int64_t utime;
        std::vector<uint8_t> bytes;
    };

    EyeThread(const Config &config, uint64_t seed, lcm_t *lcm, bool may_drop);

    void serve_jobs();
    bool start(std::string *error);
    bool next(EyeJob *job);
    void expose(const EyeJob &job);
    void await_turn(int64_t utime);
    void publish(const std::vector<uint8_t> &bytes);

    const Config &config_;
    const bool may_drop_;
    lcm_t *lcm_;
    Sensor sensor_;
    std::unique_ptr<Renderer> renderer_; /* made and used in the thread */
    std::unique_ptr<ImageMessage> encoder_;
    StereoPixels pixels_;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<EyeJob> jobs_;
    std::deque<Sent> sent_;
    int64_t due_ = 0, answered_ = 0; /* exposures, us */
    bool started_ = false, failed_ = false, ending_ = false;
    std::string start_error_;
    int64_t dropped_ = 0;
    std::thread thread_;
};

} // namespace sim
#endif
