/* simrobot: start-up order, signals, shut-down. */
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "common/bus/open.h"
#include "common/program/log.h"
#include "common/program/notify.h"
#include "simrobot/command_line.h"
#include "simrobot/eyes/egl_context.h"
#include "simrobot/eyes/eye_thread.h"
#include "simrobot/eyes/onlooker.h"
#include "simrobot/eyes/tasks.h"
#include "simrobot/run/clock_lockstep.h"
#include "simrobot/run/clock_realtime.h"
#include "simrobot/setup/meshes.h"
#include "simrobot/world/probe.h"
#include "simrobot/world/strength.h"

namespace
{

volatile sig_atomic_t stop_wanted;

void on_signal(int)
{
    stop_wanted = 1;
}

/* Both clocks ask several times a second, also while they wait for others: a sign of life. */
bool stopping()
{
    static notify_watchdog watchdog = notify_watchdog_open();

    notify_watchdog_feed(&watchdog, bus_monotonic_us());
    return stop_wanted != 0;
}

void catch_signals()
{
    struct sigaction action = {};

    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

/* Raw pairs come as 29 fragments at once; a receiver whose buffer is too small loses them all. */
void warn_of_small_buffers(const sim::Config &config)
{
    long long most = bus_receive_buffer_most(), pair = 2ll * config.width * config.height * 3;

    if (config.image_format == static_cast<int>(sim::ImageFormat::rgb) && most && most < 2 * pair)
        log_warning("raw images of %lld bytes a pair will be lost: a socket holds %lld; sysctl -w "
                    "net.core.rmem_max=%lld, or images.format: jpeg",
                    pair, most, 2 * pair);
}

std::vector<std::string> joint_names(const sim::Rig &rig)
{
    std::vector<std::string> names;
    for (int segment : rig.joints)
        names.push_back(rig.description.segments[static_cast<size_t>(segment)].name);
    return names;
}

/* On the bus until the end. */
bool run_on_bus(const sim::CommandLine &line, const sim::Config &config,
                sim::Simulation &simulation, std::string *error)
{
    auto seed = static_cast<uint64_t>(line.seed);
    std::unique_ptr<sim::SimBus> bus =
        sim::SimBus::open(line.url, line.truth_url, joint_names(simulation.rig()), error);
    std::unique_ptr<sim::EyeThread> eyes;
    std::unique_ptr<sim::Onlooker> onlooker;
    sim::ClockControl control;

    if (!bus)
        return false;
    if (line.eyes && simulation.rig().has_eyes) {
        warn_of_small_buffers(config);
        eyes = sim::EyeThread::create(config, seed, bus->lcm(), !line.lockstep, error);
        if (!eyes)
            return false;
    }
    if (line.view) {
        onlooker = sim::Onlooker::create(config, simulation.rig().has_eyes, bus->lcm(),
                                         !line.lockstep, error);
        if (!onlooker)
            return false;
    }
    control.lockstep = line.lockstep;
    control.until = line.hold ? 0 : INT64_MAX;
    sim::Session session(config, simulation, *bus, eyes.get(), control, line.send_truth);
    session.set_onlooker(onlooker.get());
    notify_send("READY=1\nSTATUS=running in %s", line.lockstep ? "lockstep" : "real time");
    bool good = line.lockstep ? sim::lockstep_run(config, session, *bus, stopping, error)
                              : sim::realtime_run(config, session, *bus, stopping, error);
    notify_send("STOPPING=1");
    if (config.collisions)
        log_info("robot and tool touched each other for %.1f %% of the time",
                 100.0 * static_cast<double>(simulation.touching_steps()) /
                     static_cast<double>(std::max<int64_t>(simulation.steps(), 1)));
    log_info("ended after %.3f s of the world's time, %lld messages refused",
             static_cast<double>(simulation.elapsed()) * 1e-6,
             static_cast<long long>(bus->refused()));
    return good;
}

bool start(const sim::CommandLine &line, std::string *error)
{
    sim::Config config;
    sim::Rig rig;
    auto seed = static_cast<uint64_t>(line.seed);

    if (!sim::config_load(&config, line.config, line.overrides, line.n_overrides, error))
        return false;
    if (line.package_path)
        snprintf(config.package_path, sizeof config.package_path, "%s", line.package_path);
    if (!sim::rig_load(config, &rig, error))
        return false;
    if (rig.has_eyes || line.snapshot || line.view || line.check)
        sim::meshes_load(config.package_path, &rig.description, &rig.notes);
    for (const std::string &note : sim::strength_notes(rig, config.ball_mass))
        rig.notes.push_back(note);
    for (const std::string &note : rig.notes)
        log_warning("%s", note.c_str());
    if (line.check)
        return true;
    if (line.probe) {
        sim::probe_postures(config, rig, seed, line.probe, stdout);
        sim::probe_swing(config, rig, seed, 2, stdout);
        sim::probe_speeds(config, rig, seed, 600, stdout);
        return true;
    }
    sim::Simulation simulation(config, rig, seed);
    if (!simulation.set_tool(static_cast<int>(line.tool))) {
        *error = std::string(line.config) + ": there is no tool " + std::to_string(line.tool);
        return false;
    }
    if (!rig.has_eyes && line.bench_eyes) {
        *error = std::string(line.config) + ": this robot has no eyes";
        return false;
    }
    if (line.bench_eyes)
        return sim::eye_task_bench(config, simulation, seed, line.bench_eyes, error);
    if (line.snapshot)
        return sim::eye_task_snapshot(config, simulation, seed, line.snapshot, error);
    return run_on_bus(line, config, simulation, error);
}

int name_renderer()
{
    std::string error;
    std::unique_ptr<sim::EglContext> context = sim::EglContext::create(&error);

    puts(context ? context->renderer().c_str() : error.c_str());
    return context ? 0 : 1;
}

} // namespace

int main(int argc, char **argv)
{
    sim::CommandLine line;
    std::string error;

    int status = sim::command_line_parse(argc, argv, &line);
    if (status >= 0)
        return status;
    log_open("reach-simrobot", line.verbose ? LOG_LEVEL_DEBUG : LOG_LEVEL_INFO);
    catch_signals();
    if (line.renderer)
        return name_renderer();
    if (start(line, &error))
        return 0;
    std::istringstream lines(error);
    for (std::string text; std::getline(lines, text);)
        log_error("%s", text.c_str());
    return 1;
}
