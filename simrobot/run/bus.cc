#include "simrobot/run/bus.h"

#include <bot_core_joint_state_t.h>
#include <poll.h>
#include <reach_hello_t.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "common/program/log.h"

namespace sim
{
namespace
{

/* More requests than this at once are nobody's typing. */
const size_t most_requests = 64;

} // namespace

std::unique_ptr<SimBus> SimBus::open(const char *url, const char *truth_url,
                                     std::vector<std::string> joint_names, std::string *error)
{
    std::unique_ptr<SimBus> bus(new SimBus);
    char line[512] = "";

    bus->joint_names_ = std::move(joint_names);
    bus->lcm_ = bus_open(url, line, sizeof line);
    bus->truth_lcm_ = bus->lcm_;
    if (bus->lcm_ && truth_url && *truth_url)
        bus->truth_lcm_ = bus_open(truth_url, line, sizeof line);
    if (!bus->lcm_ || !bus->truth_lcm_) {
        *error = line;
        return nullptr;
    }
    /* Before the role is claimed: from then on it is answered who asks whether a simulator is
     * there, and what he sends next must be heard. */
    if (!bus->subscribe(error))
        return nullptr;
    int taken = bus_claim_role(bus->lcm_, REACH_HELLO_T_SIMULATOR, 300, &bus->claim_);
    if (taken != 0) {
        *error = taken > 0 ? "another simrobot is on this bus; stop it or use another --url"
                           : "the bus failed while asking for other simulators";
        return nullptr;
    }
    return bus;
}

bool SimBus::subscribe(std::string *error)
{
    if (lcm_subscribe(lcm_, "ROBOT_COMMAND", on_command, this) &&
        lcm_subscribe(lcm_, "REACH_STATUS", on_status, this) &&
        lcm_subscribe(truth_lcm_, "SIM_REQUEST", on_request, this))
        return true;
    *error = "LCM refused to subscribe";
    return false;
}

SimBus::~SimBus()
{
    if (truth_lcm_ && truth_lcm_ != lcm_)
        lcm_destroy(truth_lcm_);
    if (lcm_)
        lcm_destroy(lcm_);
    bus_claim_free(claim_);
}

bool SimBus::handle(int milliseconds)
{
    struct pollfd fds[2] = {{lcm_get_fileno(lcm_), POLLIN, 0},
                            {lcm_get_fileno(truth_lcm_), POLLIN, 0}};
    nfds_t n = truth_lcm_ == lcm_ ? 1 : 2;

    for (;;) {
        int ready = poll(fds, n, milliseconds);
        if (ready <= 0)
            return ready == 0 || errno == EINTR;
        if ((fds[0].revents && lcm_handle(lcm_) < 0) ||
            (n == 2 && fds[1].revents && lcm_handle(truth_lcm_) < 0))
            return false;
        milliseconds = 0;
    }
}

void SimBus::refuse(const char *what, const std::string &why)
{
    int64_t now = bus_monotonic_us();

    refused_++;
    if (last_warning_ && now - last_warning_ < 1000000)
        return;
    last_warning_ = now;
    log_warning("%s refused (%lld so far): %s", what, static_cast<long long>(refused_),
                why.c_str());
}

void SimBus::on_command(const lcm_recv_buf_t *message, const char *, void *user)
{
    static_cast<SimBus *>(user)->receive_command(message);
}

void SimBus::receive_command(const lcm_recv_buf_t *message)
{
    reach_robot_command_t received;
    auto n = static_cast<int>(joint_names_.size());

    if (reach_robot_command_t_decode(message->data, 0, static_cast<int>(message->data_size),
                                     &received) < 0)
        return refuse("ROBOT_COMMAND", "not a robot_command_t");
    if (received.n_joints != n)
        return refuse("ROBOT_COMMAND", "n_joints is " + std::to_string(received.n_joints) +
                                           ", the robot has " + std::to_string(n));
    if (!std::all_of(received.velocity, received.velocity + n,
                     [](double v) { return std::isfinite(v); }))
        return refuse("ROBOT_COMMAND", "a velocity is not finite");
    command_.state_seq = received.state_seq;
    command_.received = bus_monotonic_us();
    command_.velocity.assign(received.velocity, received.velocity + n);
    has_command_ = true;
}

bool SimBus::take_command(Command *command)
{
    if (!has_command_)
        return false;
    *command = command_;
    has_command_ = false;
    return true;
}

void SimBus::on_status(const lcm_recv_buf_t *message, const char *, void *user)
{
    auto *bus = static_cast<SimBus *>(user);

    if (reach_status_t_decode(message->data, 0, static_cast<int>(message->data_size),
                              &bus->status_) < 0)
        return bus->refuse("REACH_STATUS", "not a status_t");
    bus->has_status_ = true;
}

bool SimBus::take_status(reach_status_t *status)
{
    if (!has_status_)
        return false;
    *status = status_;
    has_status_ = false;
    return true;
}

void SimBus::on_request(const lcm_recv_buf_t *message, const char *, void *user)
{
    auto *bus = static_cast<SimBus *>(user);
    reach_sim_request_t request;

    if (reach_sim_request_t_decode(message->data, 0, static_cast<int>(message->data_size),
                                   &request) < 0)
        return bus->refuse("SIM_REQUEST", "not a sim_request_t");
    if (request.seq == bus->last_request_)
        return;
    if (bus->requests_.size() >= most_requests)
        return bus->refuse("SIM_REQUEST", "too many wait already");
    bus->last_request_ = request.seq;
    bus->requests_.push_back(request);
}

bool SimBus::take_request(reach_sim_request_t *request)
{
    if (requests_.empty())
        return false;
    *request = requests_.front();
    requests_.pop_front();
    return true;
}

void SimBus::publish_state(const reach_robot_state_t &state)
{
    float position[16] = {}, velocity[16] = {}, effort[16] = {};
    char *names[16] = {};
    bot_core_joint_state_t joints = {};

    for (size_t i = 0; i < joint_names_.size(); i++) {
        position[i] = static_cast<float>(state.position[i]);
        velocity[i] = static_cast<float>(state.velocity[i]);
        names[i] = joint_names_[i].data();
    }
    joints.utime = state.utime;
    joints.num_joints = static_cast<int16_t>(joint_names_.size());
    joints.joint_name = names;
    joints.joint_position = position;
    joints.joint_velocity = velocity;
    joints.joint_effort = effort;
    reach_robot_state_t_publish(lcm_, "ROBOT_STATE", &state);
    bot_core_joint_state_t_publish(lcm_, "JOINT_STATE", &joints);
}

void SimBus::publish_effector(const reach_end_effector_t &effector)
{
    reach_end_effector_t_publish(lcm_, "END_EFFECTOR", &effector);
}

void SimBus::publish_truth(const reach_sim_truth_t &truth)
{
    reach_sim_truth_t_publish(truth_lcm_, "SIM_TRUTH", &truth);
}

void SimBus::publish_contacts(const reach_sim_contacts_t &contacts)
{
    reach_sim_contacts_t_publish(truth_lcm_, "SIM_CONTACTS", &contacts);
}

} // namespace sim
