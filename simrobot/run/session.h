/* One run: joins the world, the eyes and the bus period by period. The clocks (clock_lockstep.h,
 * clock_realtime.h) decide when; this decides what. */
#ifndef SIMROBOT_RUN_SESSION_H
#define SIMROBOT_RUN_SESSION_H

#include "simrobot/eyes/exposures.h"
#include "simrobot/run/bus.h"
#include "simrobot/run/daemon_watch.h"
#include "simrobot/world/simulation.h"

namespace sim
{

class EyeThread;
class Onlooker;

/* What the experimenter has asked of the clock. */
struct ClockControl {
    bool lockstep = false;
    bool paused = false;
    bool quit = false;
    double speed = 1;          /* times real time */
    int64_t until = INT64_MAX; /* last utime at which a state may be published */
};

class Session
{
public:
    /* `eyes` may be nullptr; `send_truth` false: nothing ever goes out on SIM_TRUTH and
     * SIM_CONTACTS. */
    Session(const Config &config, Simulation &simulation, SimBus &bus, EyeThread *eyes,
            const ClockControl &control, bool send_truth);

    /* Whom the robot is shown to from now on, every second period; nullptr: nobody. */
    void set_onlooker(Onlooker *onlooker)
    {
        onlooker_ = onlooker;
    }

    /* utime of the world's present instant. */
    int64_t now() const
    {
        return start_ + simulation_.elapsed();
    }

    /* Sets the utime of the present instant: at the start, and when real time was lost. */
    void set_now(int64_t utime)
    {
        start_ = utime - simulation_.elapsed();
    }

    /* Whether no state may go out now: paused, or as far as the experimenter allowed. */
    bool standing() const
    {
        return control_.paused || now() > control_.until;
    }

    /* Carries out all requests that wait, and says what reachd has against this robot. A clock that
     * stood or now stands acknowledges at once; else the next state's truth does. */
    void handle_requests();

    const ClockControl &control() const
    {
        return control_;
    }

    /* Physics steps in a control period, and their length in us. */
    int steps_in_period() const
    {
        return simulation_.steps_in_period();
    }
    int64_t step_us() const
    {
        return simulation_.step_us();
    }

    /* Reads the encoders and publishes the state of this instant, with its truth. Before it the
     * measured end-effector, for robots that have this sense. */
    void publish_state();

    /* Whether images go out, and how many joints a state has. */
    bool has_eyes() const
    {
        return eyes_ != nullptr;
    }
    int n_joints() const
    {
        return state_.n_joints;
    }

    /* Publishes the newest state again, and what its tick waits for: image pair, end-effector. */
    void resend_state();
    int64_t state_seq() const
    {
        return state_.seq;
    }

    void command(const std::vector<double> &velocities);

    /* One physics step; exposes the cameras when it is time. `release`: CLOCK_MONOTONIC us at
     * which an image exposed now may go out, 0 = as soon as it is ready. */
    void step(int64_t release);

private:
    void carry_out(const reach_sim_request_t &request);
    std::string refuse_reason(const reach_sim_request_t &request) const;
    void expose(int64_t release);
    void measure_effector();
    void publish_truth(bool exposure, int64_t seq);
    void publish_contacts(const Truth &truth);
    void look_at_daemon();

    Simulation &simulation_;
    SimBus &bus_;
    DaemonWatch daemon_watch_;
    EyeThread *eyes_;
    Onlooker *onlooker_ = nullptr;
    bool looks_on_ = true;
    ClockControl control_;
    bool send_truth_;
    bool send_effector_;
    Exposures exposures_;
    int64_t start_ = 0;
    int64_t request_seq_ = 0;
    bool touched_ = false; /* when it was last told what touches */
    reach_robot_state_t state_ = {};
    reach_end_effector_t effector_ = {};
};

} // namespace sim
#endif
