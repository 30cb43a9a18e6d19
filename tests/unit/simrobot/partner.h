/* The simulator in a thread, and who talks to it: the daemon and the experimenter of a test. */
#ifndef SIMROBOT_TEST_PARTNER_H
#define SIMROBOT_TEST_PARTNER_H

#include <atomic>
#include <functional>
#include <thread>

#include "simrobot/eyes/eye_thread.h"
#include "simrobot/run/clock_lockstep.h"

#include "fixture.h"

inline lcm_t *open_bus(const char *url = nullptr)
{
    char error[512];
    lcm_t *lcm = bus_open(url, error, sizeof error);
    if (!lcm)
        ck_abort_msg("%s", error);
    return lcm;
}

inline std::unique_ptr<sim::SimBus> open_simulator(const char *truth_url = nullptr,
                                                   size_t joints = 6)
{
    std::string error;
    auto bus = sim::SimBus::open(nullptr, truth_url, std::vector<std::string>(joints, "a"), &error);
    if (!bus)
        ck_abort_msg("%s", error.c_str());
    return bus;
}

/* What a test does in the daemon's and the experimenter's place. */
class Partner
{
public:
    explicit Partner(const char *truth_url = nullptr) : lcm_(open_bus())
    {
        truth_lcm_ = truth_url ? open_bus(truth_url) : lcm_;
        reach_robot_state_t_subscribe(lcm_, "ROBOT_STATE", on_state, this);
        reach_end_effector_t_subscribe(lcm_, "END_EFFECTOR", on_effector, this);
        reach_sim_truth_t_subscribe(truth_lcm_, "SIM_TRUTH", on_truth, this);
        reach_sim_contacts_t_subscribe(truth_lcm_, "SIM_CONTACTS", on_contacts, this);
        lcm_subscribe(lcm_, "STEREO_IMAGES", on_images, this);
    }

    ~Partner()
    {
        if (truth_lcm_ != lcm_)
            lcm_destroy(truth_lcm_);
        lcm_destroy(lcm_);
    }

    /* Handles messages until the condition holds; false when that takes too long. */
    bool wait(const std::function<bool()> &condition, int milliseconds = 5000)
    {
        int64_t end = bus_monotonic_us() + milliseconds * 1000;
        while (!condition()) {
            if (bus_monotonic_us() > end)
                return false;
            lcm_handle_timeout(lcm_, 5);
            if (truth_lcm_ != lcm_)
                lcm_handle_timeout(truth_lcm_, 5);
        }
        return true;
    }

    void answer(double velocity)
    {
        reach_robot_command_t command = {};
        command.state_seq = states.back().seq;
        command.n_joints = 6;
        for (int i = 0; i < 6; i++)
            command.velocity[i] = i == 3 ? velocity : 0;
        reach_robot_command_t_publish(lcm_, "ROBOT_COMMAND", &command);
    }

    /* Answers states until one of this number has come. */
    bool drive(int64_t until_seq, double velocity)
    {
        size_t answered = states.size();
        return wait([&] {
            if (states.size() > answered) {
                answered = states.size();
                if (states.back().seq < until_seq)
                    answer(velocity);
            }
            return !states.empty() && states.back().seq >= until_seq;
        });
    }

    void request(int kind, int64_t seq, int tool = 0, double value = 0, int64_t until = 0)
    {
        reach_sim_request_t request = {};
        request.seq = seq;
        request.kind = static_cast<int8_t>(kind);
        request.tool = tool;
        request.value = value;
        request.until = until;
        reach_sim_request_t_publish(truth_lcm_, "SIM_REQUEST", &request);
    }

    bool acknowledged(int64_t seq, int milliseconds = 5000)
    {
        return wait([&] { return !truths.empty() && truths.back().request_seq == seq; },
                    milliseconds);
    }

    void publish(const char *channel, const void *data, size_t size)
    {
        lcm_publish(lcm_, channel, data, static_cast<unsigned>(size));
    }

    std::vector<reach_robot_state_t> states;
    std::vector<reach_sim_truth_t> truths;
    std::vector<reach_sim_contacts_t> contacts;
    std::vector<reach_end_effector_t> effectors;
    std::vector<std::string> order; /* of what came, channel by channel */
    std::vector<std::vector<uint8_t>> images;

private:
    static void on_state(const lcm_recv_buf_t *, const char *, const reach_robot_state_t *state,
                         void *user)
    {
        static_cast<Partner *>(user)->states.push_back(*state);
        static_cast<Partner *>(user)->order.emplace_back("state");
    }

    static void on_effector(const lcm_recv_buf_t *, const char *,
                            const reach_end_effector_t *effector, void *user)
    {
        static_cast<Partner *>(user)->effectors.push_back(*effector);
        static_cast<Partner *>(user)->order.emplace_back("effector");
    }

    static void on_truth(const lcm_recv_buf_t *, const char *, const reach_sim_truth_t *truth,
                         void *user)
    {
        static_cast<Partner *>(user)->truths.push_back(*truth);
    }

    static void on_contacts(const lcm_recv_buf_t *, const char *,
                            const reach_sim_contacts_t *contacts, void *user)
    {
        static_cast<Partner *>(user)->contacts.push_back(*contacts);
    }

    static void on_images(const lcm_recv_buf_t *message, const char *, void *user)
    {
        const auto *data = static_cast<const uint8_t *>(message->data);
        static_cast<Partner *>(user)->images.emplace_back(data, data + message->data_size);
    }

    lcm_t *lcm_, *truth_lcm_;
};

inline std::atomic<bool> stop_wanted;

inline bool stopping()
{
    return stop_wanted;
}

/* Far beyond a busy machine's delays: where a state sent again would disturb the test. */
inline constexpr char patient[] = "lockstep.resend=20";

/* A simulator in lockstep in a thread of its own. */
class Running
{
public:
    struct Options {
        bool hold = false, eyes = false, truth = true;
        const char *truth_url = nullptr;
        uint64_t seed = 1;
        const char *resend = patient;
        const char *effector = "effector.published=false";
    };

    explicit Running(const Options &options)
        : stage_(fixture::stage({options.resend, options.effector}, {-65, -17.5, 0, -65, -22, 3}, 0,
                                options.seed)),
          bus_(open_simulator(options.truth_url))
    {
        sim::ClockControl control;
        std::string error;
        control.lockstep = true;
        control.until = options.hold ? 0 : INT64_MAX;
        if (options.eyes)
            eyes_ =
                sim::EyeThread::create(stage_->config, options.seed, bus_->lcm(), false, &error);
        ck_assert_str_eq(error.c_str(), "");
        session_ = std::make_unique<sim::Session>(stage_->config, *stage_->simulation, *bus_,
                                                  eyes_.get(), control, options.truth);
        stop_wanted = false;
        thread_ = std::thread([this] {
            std::string why;
            sim::lockstep_run(stage_->config, *session_, *bus_, stopping, &why);
            ended = true;
        });
    }

    ~Running()
    {
        stop_wanted = true;
        thread_.join();
    }

    std::atomic<bool> ended{false};

private:
    std::unique_ptr<fixture::Stage> stage_;
    std::unique_ptr<sim::SimBus> bus_;
    std::unique_ptr<sim::EyeThread> eyes_;
    std::unique_ptr<sim::Session> session_;
    std::thread thread_;
};

#endif
