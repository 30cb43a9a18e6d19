#include "simrobot/run/session.h"

#include <algorithm>
#include <cmath>

#include "common/program/log.h"
#include "simrobot/eyes/eye_thread.h"
#include "simrobot/eyes/onlooker.h"

namespace sim
{
namespace
{

const int64_t between_looks = 2000 * period_ms; /* us: two control periods */

} // namespace

Session::Session(const Config &config, Simulation &simulation, SimBus &bus, EyeThread *eyes,
                 const ClockControl &control, bool send_truth)
    : simulation_(simulation), bus_(bus), daemon_watch_(simulation.rig(), config.ball_mass),
      eyes_(eyes), control_(control), send_truth_(send_truth),
      send_effector_(config.effector_published), exposures_(std::llround(config.latency * 1e6))
{
}

/* Why a request cannot be carried out; "" if it can. */
std::string Session::refuse_reason(const reach_sim_request_t &request) const
{
    switch (request.kind) {
    case REACH_SIM_REQUEST_T_LIGHT:
        return request.value >= 0 && request.value <= 10 ? "" : "brightness must be 0 .. 10";
    case REACH_SIM_REQUEST_T_SPEED:
        if (control_.lockstep)
            return "lockstep runs as fast as it can; speed is for --realtime";
        return request.value >= 0.01 && request.value <= 100 ? "" : "speed must be 0.01 .. 100";
    case REACH_SIM_REQUEST_T_RUN_UNTIL:
        return control_.lockstep ? "" : "real time cannot be held; RUN_UNTIL is for --lockstep";
    case REACH_SIM_REQUEST_T_VIEW:
        return onlooker_ ? "" : "nobody looks on; start reach-simrobot with --view";
    case REACH_SIM_REQUEST_T_TOOL:
    case REACH_SIM_REQUEST_T_RESET:
    case REACH_SIM_REQUEST_T_PAUSE:
    case REACH_SIM_REQUEST_T_RESUME:
    case REACH_SIM_REQUEST_T_QUIT:
        return "";
    default:
        return "unknown kind " + std::to_string(request.kind);
    }
}

void Session::carry_out(const reach_sim_request_t &request)
{
    std::string reason = refuse_reason(request);

    if (reason.empty() && request.kind == REACH_SIM_REQUEST_T_TOOL &&
        !simulation_.set_tool(request.tool))
        reason = "there is no tool " + std::to_string(request.tool) + " in the configuration";
    if (!reason.empty())
        return bus_.refuse("SIM_REQUEST", reason);
    if (request.kind == REACH_SIM_REQUEST_T_RESET)
        simulation_.reset();
    else if (request.kind == REACH_SIM_REQUEST_T_LIGHT)
        simulation_.set_brightness(request.value);
    else if (request.kind == REACH_SIM_REQUEST_T_PAUSE)
        control_.paused = true;
    else if (request.kind == REACH_SIM_REQUEST_T_RESUME)
        control_.paused = false;
    else if (request.kind == REACH_SIM_REQUEST_T_SPEED)
        control_.speed = request.value;
    else if (request.kind == REACH_SIM_REQUEST_T_RUN_UNTIL)
        control_.until = request.until;
    else if (request.kind == REACH_SIM_REQUEST_T_VIEW)
        looks_on_ = request.value != 0;
    else if (request.kind == REACH_SIM_REQUEST_T_QUIT)
        control_.quit = true;
    request_seq_ = request.seq;
}

void Session::handle_requests()
{
    reach_sim_request_t request;
    int64_t before = request_seq_;
    bool stood = standing();

    while (bus_.take_request(&request))
        carry_out(request);
    look_at_daemon();
    if ((stood || standing()) && request_seq_ != before)
        publish_truth(false, state_.seq);
}

void Session::look_at_daemon()
{
    reach_status_t status;

    if (!bus_.take_status(&status))
        return;
    std::string line = daemon_watch_.look(status, state_, bus_monotonic_us());
    if (!line.empty())
        log_warning("%s", line.c_str());
}

/* Out before the state that it is due with, so that who waits for the state has it. */
void Session::measure_effector()
{
    Eigen::Vector3d position = simulation_.measure_effector();

    effector_.utime = now();
    effector_.seq++;
    std::copy(position.data(), position.data() + 3, effector_.position);
    bus_.publish_effector(effector_);
    state_.effector_due = effector_.utime;
}

void Session::publish_state()
{
    Reading reading = simulation_.read_encoders();

    if (send_effector_)
        measure_effector();
    state_.utime = now();
    state_.seq++;
    state_.vision_due = eyes_ ? exposures_.due(state_.utime) : 0;
    state_.lockstep = control_.lockstep;
    state_.n_joints = static_cast<int32_t>(reading.position.size());
    std::copy(reading.position.begin(), reading.position.end(), state_.position);
    std::copy(reading.velocity.begin(), reading.velocity.end(), state_.velocity);
    if (eyes_)
        eyes_->due(state_.vision_due);
    bus_.publish_state(state_);
    publish_truth(false, state_.seq);
}

void Session::command(const std::vector<double> &velocities)
{
    simulation_.command(velocities);
    if (eyes_)
        eyes_->answered(state_.vision_due);
}

void Session::resend_state()
{
    if (send_effector_)
        bus_.publish_effector(effector_);
    bus_.publish_state(state_);
    if (eyes_ && state_.vision_due)
        eyes_->publish_again(state_.vision_due);
}

void Session::step(int64_t release)
{
    simulation_.step();
    if (eyes_ && Exposures::at_step(simulation_.steps()))
        expose(release);
    if (onlooker_ && looks_on_ && simulation_.elapsed() % between_looks == 0)
        onlooker_->look(simulation_.snapshot(simulation_.elapsed() / between_looks), now());
}

void Session::expose(int64_t release)
{
    int64_t number = exposures_.add(now());

    eyes_->submit({simulation_.snapshot(number), now(), release});
    publish_truth(true, number);
}

void Session::publish_truth(bool exposure, int64_t seq)
{
    if (!send_truth_)
        return;
    Truth truth = simulation_.truth();
    reach_sim_truth_t message = {};

    message.utime = now();
    message.seq = seq;
    message.exposure = exposure;
    message.request_seq = request_seq_;
    message.tool = simulation_.tool();
    message.n_joints = static_cast<int32_t>(truth.position.size());
    std::copy(truth.position.begin(), truth.position.end(), message.position);
    std::copy(truth.velocity.begin(), truth.velocity.end(), message.velocity);
    std::copy(truth.ball.data(), truth.ball.data() + 3, message.marker);
    message.marker_speed = truth.ball_speed;
    message.in_view = truth.in_view;
    message.visible = eyes_ ? truth.visible : -1;
    message.u_right = truth.projection.u_right;
    message.v_right = truth.projection.v_right;
    message.disparity = truth.projection.u_left - truth.projection.u_right;
    message.x_fixation[0] = truth.fixation.yaw;
    message.x_fixation[1] = truth.fixation.pitch;
    message.x_fixation[2] = truth.fixation.disparity;
    message.x_valid = truth.fixation.within_limits;
    bus_.publish_truth(message);
    if (!exposure)
        publish_contacts(truth);
}

/* Most of the time nothing touches: that is not said again and again. */
void Session::publish_contacts(const Truth &truth)
{
    if (truth.touching || touched_)
        bus_.publish_contacts({now(), state_.seq, truth.touching, truth.deepest});
    touched_ = truth.touching > 0;
}

} // namespace sim
