#include "simrobot/command_line.h"

#include <cstddef>

#include "common/bus/open.h"
#include "simrobot/setup/config.h"

namespace sim
{
namespace
{

const argument_row rows[] = {
    ARGUMENT_TEXT("config", 'c', "FILE", CommandLine, config,
                  "YAML configuration, such as etc/simrobot-kobian.yaml"),
    ARGUMENT_SET(CommandLine, overrides, n_overrides),
    ARGUMENT_ON("lockstep", 'l', CommandLine, lockstep,
                "state and command take turns, as fast as they can (default)"),
    ARGUMENT_OFF("realtime", CommandLine, lockstep,
                 "50 states a second by the wall clock, whoever answers"),
    ARGUMENT_ON("hold", 0, CommandLine, hold,
                "lockstep: stand still until SIM_REQUEST RUN_UNTIL says how far"),
    ARGUMENT_INT64("seed", "N", CommandLine, seed, 0, INT64_MAX,
                   "of encoder noise, light and sensor noise (default 1)"),
    ARGUMENT_URL(CommandLine, url),
    ARGUMENT_TEXT("truth-url", 0, "URL", CommandLine, truth_url,
                  "SIM_REQUEST and SIM_TRUTH on a bus of their own"),
    ARGUMENT_OFF("no-truth", CommandLine, send_truth, "never send SIM_TRUTH"),
    ARGUMENT_OFF("no-eyes", CommandLine, eyes, "no cameras: needs no graphics"),
    ARGUMENT_ON("view", 0, CommandLine, view,
                "send on SIM_VIEW how the robot looks from its two sides, 25 times a second"),
    ARGUMENT_INT64("tool", "N", CommandLine, tool, 0, 16,
                   "tool N in the hand from the start (default 0, none)"),
    ARGUMENT_TEXT(
        "snapshot", 0, "FILE", CommandLine, snapshot,
        "write what both eyes see at the start as a PPM picture, and exit; a robot without "
        "eyes is seen from its two sides"),
    ARGUMENT_INT64("bench-eyes", "N", CommandLine, bench_eyes, 1, 1000000,
                   "draw and encode N image pairs, print the time of each part, and exit"),
    ARGUMENT_TEXT("package-path", 0, "DIRS", CommandLine, package_path,
                  "folders of packages, separated by colons, for meshes named package://..."),
    ARGUMENT_ON("check", 0, CommandLine, check,
                "say what is wrong, guessed or left out in configuration and URDF, and exit"),
    ARGUMENT_INT64("probe", "N", CommandLine, probe, 1, 1000000,
                   "print N random postures with the hand's place and gravity's torques, how "
                   "energy holds in a free swing, and how fast random commands make the joints, as "
                   "lines of JSON, and exit"),
    ARGUMENT_ON("renderer", 0, CommandLine, renderer,
                "name what draws, or say what is missing, and exit"),
    ARGUMENT_ON("verbose", 'v', CommandLine, verbose, "say more"),
    ARGUMENT_END,
};

const command_line line = {"reach-simrobot",
                           "reach-simrobot --config FILE [options]",
                           "Simulates a robot with its eyes on the LCM bus.",
                           rows,
                           "0 ended as asked, 1 something failed",
                           config_print_options,
                           nullptr,
                           nullptr};

const char *contradiction(const CommandLine &given)
{
    if (given.renderer)
        return nullptr;
    if (!given.config)
        return "--config is missing";
    if (given.hold && !given.lockstep)
        return "--hold is for --lockstep; real time cannot be held";
    if (!given.eyes && (given.snapshot || given.bench_eyes))
        return "--snapshot and --bench-eyes need the eyes";
    return nullptr;
}

} // namespace

int command_line_parse(int argc, char **argv, CommandLine *given)
{
    int status = ::command_line_parse(&line, argc, argv, given);
    const char *wrong = status < 0 ? contradiction(*given) : nullptr;

    return wrong ? command_line_wrong(&line, "%s", wrong) : status;
}

} // namespace sim
