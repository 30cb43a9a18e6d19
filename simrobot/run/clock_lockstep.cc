#include "simrobot/run/clock_lockstep.h"

#include <algorithm>
#include <cmath>

#include "common/program/log.h"

namespace sim
{
namespace
{

/* Signals are looked at this often while nothing happens. */
const int longest_wait_ms = 100;

const int64_t first_utime = 1000000;

class Lockstep
{
public:
    Lockstep(const Config &config, Session &session, SimBus &bus, bool (*stopping)())
        : resend_us_(std::llround(config.lockstep_resend * 1e6)),
          timeout_us_(std::llround(config.lockstep_timeout * 1e6)), session_(session), bus_(bus),
          stopping_(stopping)
    {
    }

    bool run_to_the_end()
    {
        session_.set_now(first_utime);
        while (wait_for_leave()) {
            session_.publish_state();
            if (!wait_for_command())
                break;
            for (int i = 0; i < session_.steps_in_period(); i++)
                session_.step(0);
        }
        return !failed_;
    }

private:
    bool over()
    {
        return failed_ || stopping_() || session_.control().quit;
    }

    void handle(int milliseconds)
    {
        if (!bus_.handle(milliseconds))
            failed_ = true;
    }

    /* Carries out requests; returns when the next state may go out, or false at the end. */
    bool wait_for_leave()
    {
        handle(0);
        session_.handle_requests();
        while (!over() && session_.standing()) {
            handle(longest_wait_ms);
            session_.handle_requests();
        }
        return !over();
    }

    /* Until the command that answers the newest state is there; false at the end. */
    bool wait_for_command()
    {
        int64_t asked = bus_monotonic_us(), sent = asked;
        Command command;

        while (!over()) {
            handle(static_cast<int>(std::min<int64_t>(longest_wait_ms, resend_us_ / 1000 + 1)));
            if (bus_.take_command(&command) && command.state_seq == session_.state_seq()) {
                session_.command(command.velocity);
                return true;
            }
            int64_t now = bus_monotonic_us();
            if (now - sent >= resend_us_) {
                session_.resend_state();
                sent = now;
                complain(now - asked);
            }
        }
        return false;
    }

    void complain(int64_t waited)
    {
        int64_t now = bus_monotonic_us();
        if (waited < timeout_us_ || now - complained_ < 1000000)
            return;
        complained_ = now;
        log_warning("reachd has not answered state %lld for %.1f s; is it running with "
                    "--lockstep%s, and are the %d joints within its arm.min .. arm.max?",
                    static_cast<long long>(session_.state_seq()),
                    static_cast<double>(waited) * 1e-6,
                    session_.has_eyes() ? ", vision beside it" : "", session_.n_joints());
    }

    const int64_t resend_us_, timeout_us_;
    Session &session_;
    SimBus &bus_;
    bool (*stopping_)();
    bool failed_ = false;
    int64_t complained_ = 0;
};

} // namespace

bool lockstep_run(const Config &config, Session &session, SimBus &bus, bool (*stopping)(),
                  std::string *error)
{
    if (Lockstep(config, session, bus, stopping).run_to_the_end())
        return true;
    *error = "the LCM bus failed";
    return false;
}

} // namespace sim
