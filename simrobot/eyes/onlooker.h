/* Pictures of the robot from outside, for people who watch it. In a thread of its own: neither
 * physics nor the eyes wait for a picture to be drawn.
 *
 * Channel SIM_VIEW has a bot_core images_t: LEFT and RIGHT are what a bystander sees from the
 * robot's left and right. Each image has a note "camera", and LEFT of a robot with eyes also
 * "left_eye" and "right_eye": a 3 x 4 matrix P, row after row as big-endian doubles, of the camera
 * that took it or of that eye. (u w, v w, w) = P (x, y, z, 1): a point in the base's frame, m, is
 * at u to the right and v down from the image's centre, px, and in front of the camera where w > 0.
 */
#ifndef SIMROBOT_EYES_ONLOOKER_H
#define SIMROBOT_EYES_ONLOOKER_H

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "common/bus/open.h"
#include "simrobot/eyes/bystander.h"
#include "simrobot/eyes/image_message.h"
#include "simrobot/eyes/renderer.h"

namespace sim
{

class Onlooker
{
public:
    /* Starts the thread. `may_drop`: a picture that comes while another is drawn is left out (real
     * time); else look() waits (lockstep). `robot_sees`: snapshots have its eyes.
     *   returns nullptr with one line in `error` when there is nothing to draw with. */
    static std::unique_ptr<Onlooker> create(const Config &config, bool robot_sees, lcm_t *lcm,
                                            bool may_drop, std::string *error);

    /* Finishes the picture that is drawn, then ends the thread. */
    ~Onlooker();
    Onlooker(const Onlooker &) = delete;
    Onlooker &operator=(const Onlooker &) = delete;

    void look(Snapshot snapshot, int64_t utime);

private:
    struct Job {
        Snapshot snapshot;
        int64_t utime;
    };

    Onlooker(const Config &config, bool robot_sees, lcm_t *lcm, bool may_drop);

    void serve();
    bool start(std::string *error);
    void draw(Job job);

    const Config &config_;
    const bool robot_sees_, may_drop_;
    lcm_t *lcm_;
    Bystander bystander_;
    std::unique_ptr<Renderer> renderer_; /* made and used in the thread */
    std::unique_ptr<ImageMessage> encoder_;
    StereoPixels pixels_;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> job_; /* waits, or is being drawn */
    bool ready_ = false, ending_ = false;
    std::string start_error_;
    std::thread thread_;
};

} // namespace sim
#endif
