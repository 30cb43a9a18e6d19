#include "simrobot/command_line.h"

#include <getopt.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

namespace sim
{
namespace
{

const char help[] =
    "usage: reach-simrobot --config FILE [option ...]\n"
    "Simulates a robot with its eyes on the LCM bus.\n"
    "\n"
    "  --config FILE       YAML configuration, such as etc/simrobot-kobian.yaml\n"
    "  --set NAME=VALUE    overrides one option of it; may be repeated\n"
    "  --help-options      lists every option of the configuration\n"
    "  --lockstep          state and command take turns, as fast as they can (default)\n"
    "  --realtime          50 states a second by the wall clock, whoever answers\n"
    "  --hold              lockstep: stand still until SIM_REQUEST RUN_UNTIL says how far\n"
    "  --seed N            of encoder noise, light and sensor noise (default 1)\n"
    "  --url URL           LCM bus (default $LCM_DEFAULT_URL, else loopback multicast)\n"
    "  --truth-url URL     SIM_REQUEST and SIM_TRUTH on a bus of their own\n"
    "  --no-truth          never send SIM_TRUTH\n"
    "  --no-eyes           no cameras: needs no graphics\n"
    "  --tool N            tool N in the hand from the start (default 0, none)\n"
    "  --snapshot FILE     write what both eyes see at the start as a PPM picture, and exit; a\n"
    "                      robot without eyes is seen from its two sides\n"
    "  --bench-eyes N      draw and encode N image pairs, print the time of each part, and exit\n"
    "  --renderer          name what draws, or say what is missing, and exit\n"
    "  --verbose           more on stderr\n"
    "  --help              this text\n"
    "  --version           version and git revision\n"
    "\n"
    "Exit status: 0 ended as asked, 1 something failed, 2 wrong usage.\n";

enum Choice {
    choice_config = 256,
    choice_set,
    choice_help_options,
    choice_lockstep,
    choice_realtime,
    choice_hold,
    choice_seed,
    choice_url,
    choice_truth_url,
    choice_no_truth,
    choice_no_eyes,
    choice_snapshot,
    choice_tool,
    choice_bench_eyes,
    choice_renderer,
    choice_verbose,
    choice_help,
    choice_version
};

const struct option rows[] = {{"config", required_argument, nullptr, choice_config},
                              {"set", required_argument, nullptr, choice_set},
                              {"help-options", no_argument, nullptr, choice_help_options},
                              {"lockstep", no_argument, nullptr, choice_lockstep},
                              {"realtime", no_argument, nullptr, choice_realtime},
                              {"hold", no_argument, nullptr, choice_hold},
                              {"seed", required_argument, nullptr, choice_seed},
                              {"url", required_argument, nullptr, choice_url},
                              {"truth-url", required_argument, nullptr, choice_truth_url},
                              {"no-truth", no_argument, nullptr, choice_no_truth},
                              {"no-eyes", no_argument, nullptr, choice_no_eyes},
                              {"snapshot", required_argument, nullptr, choice_snapshot},
                              {"tool", required_argument, nullptr, choice_tool},
                              {"bench-eyes", required_argument, nullptr, choice_bench_eyes},
                              {"renderer", no_argument, nullptr, choice_renderer},
                              {"verbose", no_argument, nullptr, choice_verbose},
                              {"help", no_argument, nullptr, choice_help},
                              {"version", no_argument, nullptr, choice_version},
                              {nullptr, 0, nullptr, 0}};

bool wrong_usage(const char *what)
{
    fprintf(stderr, "reach-simrobot: %s; see reach-simrobot --help\n", what);
    return false;
}

bool set_number(const char *name, int64_t low, int64_t high, int64_t *value)
{
    char *end;
    *value = strtoll(optarg, &end, 10);
    if (end != optarg && !*end && *value >= low && *value <= high)
        return true;
    fprintf(stderr, "reach-simrobot: --%s %s: a whole number %lld .. %lld is wanted\n", name,
            optarg, static_cast<long long>(low), static_cast<long long>(high));
    return false;
}

bool set_text_option(int choice, CommandLine *line)
{
    if (choice == choice_config)
        line->config = optarg;
    else if (choice == choice_set)
        line->overrides.push_back(optarg);
    else if (choice == choice_url)
        line->url = optarg;
    else if (choice == choice_truth_url)
        line->truth_url = optarg;
    else
        line->snapshot = optarg;
    return true;
}

/* Takes one option.
 *   returns false, having said why, when it is wrong. */
bool take(int choice, CommandLine *line)
{
    switch (choice) {
    case choice_lockstep:
        return line->lockstep = true;
    case choice_realtime:
        line->lockstep = false;
        return true;
    case choice_hold:
        return line->hold = true;
    case choice_seed:
        return set_number("seed", 0, INT64_MAX, &line->seed);
    case choice_no_truth:
        line->send_truth = false;
        return true;
    case choice_no_eyes:
        line->eyes = false;
        return true;
    case choice_tool:
        return set_number("tool", 0, 16, &line->tool);
    case choice_bench_eyes:
        return set_number("bench-eyes", 1, 1000000, &line->bench_eyes);
    case choice_verbose:
        return line->verbose = true;
    case choice_help:
        line->task = Task::help;
        return true;
    case choice_help_options:
        line->task = Task::help_options;
        return true;
    case choice_renderer:
        line->task = Task::renderer;
        return true;
    case choice_version:
        line->task = Task::version;
        return true;
    case '?':
        return false; /* getopt has said why */
    default:
        return set_text_option(choice, line);
    }
}

bool check(const CommandLine &line)
{
    if (line.task != Task::run)
        return true;
    if (line.config.empty())
        return wrong_usage("--config FILE must be given");
    if (line.hold && !line.lockstep)
        return wrong_usage("--hold is for --lockstep; real time cannot be held");
    if (!line.eyes && (!line.snapshot.empty() || line.bench_eyes))
        return wrong_usage("--snapshot and --bench-eyes need the eyes");
    return true;
}

} // namespace

bool command_line_parse(int argc, char **argv, CommandLine *line)
{
    int choice;

    argv[0] = program_invocation_short_name; /* what getopt puts in front of its complaints */
    while ((choice = getopt_long(argc, argv, "", rows, nullptr)) != -1)
        if (!take(choice, line))
            return false;
    if (optind < argc)
        return wrong_usage("it takes options only");
    return check(*line);
}

const char *command_line_help()
{
    return help;
}

} // namespace sim
