/* The simulator on the LCM bus: what it hears is checked here, what it says is packed here. */
#ifndef SIMROBOT_RUN_BUS_H
#define SIMROBOT_RUN_BUS_H

#include <reach_end_effector_t.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <reach_sim_contacts_t.h>
#include <reach_sim_request_t.h>
#include <reach_sim_truth_t.h>
#include <reach_status_t.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/open.h"

namespace sim
{

/* A command that was checked: as many finite velocities as the robot has joints. */
struct Command {
    int64_t state_seq;
    int64_t received; /* CLOCK_MONOTONIC, us */
    std::vector<double> velocity;
};

class SimBus
{
public:
    /* `url` and `truth_url` NULL or "": the default; a truth_url of its own puts SIM_REQUEST,
     * SIM_TRUTH and SIM_CONTACTS there. Refuses when another simulator is on the bus.
     *   returns nullptr with one line in `error`. */
    static std::unique_ptr<SimBus> open(const char *url, const char *truth_url,
                                        std::vector<std::string> joint_names, std::string *error);
    ~SimBus();
    SimBus(const SimBus &) = delete;
    SimBus &operator=(const SimBus &) = delete;

    /* Handles what has come, waiting up to `milliseconds` for the first message. Signals end the
     * wait.
     *   returns false when the bus fails. */
    bool handle(int milliseconds);

    /* The newest command, if one has come since it was last taken. */
    bool take_command(Command *command);

    /* What reachd said last of itself.
     *   returns whether there is something new. */
    bool take_status(reach_status_t *status);

    /* The oldest request that waits. Repeats (same seq) are not handed out. */
    bool take_request(reach_sim_request_t *request);

    /* ROBOT_STATE, and JOINT_STATE with the same numbers for others' tools. */
    void publish_state(const reach_robot_state_t &state);
    void publish_effector(const reach_end_effector_t &effector);
    void publish_truth(const reach_sim_truth_t &truth);
    void publish_contacts(const reach_sim_contacts_t &contacts);

    /* Counts and warns of, at most once a second, something from outside that was refused. */
    void refuse(const char *what, const std::string &why);
    int64_t refused() const
    {
        return refused_;
    }

    /* For the thread of the eyes: lcm_publish may be called from any thread. */
    lcm_t *lcm() const
    {
        return lcm_;
    }

private:
    SimBus() = default;

    bool subscribe(std::string *error);
    static void on_command(const lcm_recv_buf_t *message, const char *channel, void *user);
    static void on_request(const lcm_recv_buf_t *message, const char *channel, void *user);
    static void on_status(const lcm_recv_buf_t *message, const char *channel, void *user);
    void receive_command(const lcm_recv_buf_t *message);

    lcm_t *lcm_ = nullptr;
    lcm_t *truth_lcm_ = nullptr; /* the same as lcm_ unless it has a URL of its own */
    struct bus_claim *claim_ = nullptr;
    std::vector<std::string> joint_names_;
    Command command_ = {};
    bool has_command_ = false;
    reach_status_t status_ = {};
    bool has_status_ = false;
    std::deque<reach_sim_request_t> requests_;
    int64_t last_request_ = 0;
    int64_t refused_ = 0;
    int64_t last_warning_ = 0;
};

} // namespace sim
#endif
