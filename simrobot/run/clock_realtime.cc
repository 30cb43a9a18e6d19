#include "simrobot/run/clock_realtime.h"

#include <algorithm>
#include <cmath>

#include "common/base/thread.h"
#include "common/program/log.h"

namespace sim
{
namespace
{

/* Later than this behind the grid, the grid is given up and begun anew. */
const int64_t largest_lag_us = 100000;

class RealTime
{
public:
    RealTime(const Config &config, Session &session, SimBus &bus, bool (*stopping)())
        : timeout_us_(std::llround(config.command_timeout * 1e6)),
          latency_us_(std::llround(config.latency * 1e6)), session_(session), bus_(bus),
          stopping_(stopping)
    {
    }

    bool run_to_the_end()
    {
        start_grid();
        while (!failed_ && !stopping_() && !session_.control().quit) {
            take_command(0);
            session_.handle_requests();
            if (session_.control().paused) {
                stand();
                continue;
            }
            if (session_.control().speed != grid_speed_)
                start_grid();
            session_.publish_state();
            run_period();
        }
        return !failed_;
    }

private:
    /* The present instant of the world is now. */
    void start_grid()
    {
        grid_speed_ = session_.control().speed;
        grid_start_ = bus_monotonic_us();
        grid_steps_ = 0;
        /* Never backwards, also after a time at more than real speed. */
        session_.set_now(std::max(session_.now(), bus_utime()));
    }

    void stand()
    {
        take_command(100);
        session_.handle_requests();
        if (!session_.control().paused)
            start_grid();
    }

    void take_command(int milliseconds)
    {
        Command command;

        if (!bus_.handle(milliseconds))
            failed_ = true;
        if (bus_.take_command(&command)) {
            newest_ = command;
            session_.command(newest_.velocity);
        } else if (!newest_.velocity.empty() &&
                   bus_monotonic_us() - newest_.received > timeout_us_) {
            /* Nobody drives any more: a driver that keeps the last speed would run into a wall. */
            newest_.velocity.assign(newest_.velocity.size(), 0.0);
            session_.command(newest_.velocity);
        }
    }

    void run_period()
    {
        for (int i = 0; i < session_.steps_in_period(); i++) {
            grid_steps_++;
            int64_t at =
                grid_start_ +
                std::llround(static_cast<double>(grid_steps_ * session_.step_us()) / grid_speed_);
            int64_t now = bus_monotonic_us();
            if (now - at > largest_lag_us)
                return catch_up(now - at);
            if (at > now)
                sleep_until(at * 1000);
            take_command(0);
            session_.step(at + latency_us_);
        }
    }

    void catch_up(int64_t lag)
    {
        int64_t now = bus_monotonic_us();

        slips_++;
        start_grid();
        if (now - warned_ < 1000000)
            return;
        warned_ = now;
        log_warning("this machine is too slow: %.0f ms of real time lost (%lld times so far)",
                    static_cast<double>(lag) * 1e-3, static_cast<long long>(slips_));
    }

    const int64_t timeout_us_, latency_us_;
    Session &session_;
    SimBus &bus_;
    bool (*stopping_)();
    bool failed_ = false;
    Command newest_ = {};
    double grid_speed_ = 1;
    int64_t grid_start_ = 0;
    int64_t grid_steps_ = 0;
    int64_t slips_ = 0;
    int64_t warned_ = 0;
};

} // namespace

bool realtime_run(const Config &config, Session &session, SimBus &bus, bool (*stopping)(),
                  std::string *error)
{
    if (RealTime(config, session, bus, stopping).run_to_the_end())
        return true;
    *error = "the LCM bus failed";
    return false;
}

} // namespace sim
