#include "daemon/arguments.h"

#include "daemon/config/table.h"

#include "common/bus/open.h"
#include "common/program/version.h"

#include <getopt.h>
#include <stdio.h>

static const char usage[] =
    "usage: reachd --config FILE [options]\n"
    "       reachd --replay LOG [--verify] [options]\n"
    "Learns how the robot's arm moves, with whatever tool it holds, and reaches with it.\n\n"
    "  -c, --config FILE     YAML configuration, such as etc/kobian.yaml; given again, the\n"
    "                        later file overrides the earlier one\n"
    "  -s, --set NAME=VALUE  override one option of it (may be repeated)\n"
    "  -u, --url URL         LCM bus (default $LCM_DEFAULT_URL, else " BUS_DEFAULT_URL ")\n"
    "  -l, --lockstep        the simulator's clock, not the real one\n"
    "      --no-rt           real time without priority and locked memory, for developers\n"
    "  -v, --verbose         say more\n"
    "      --check-model     print the samples and the hash of the model in model.directory, or "
    "what\n"
    "                        is wrong with it, and change nothing\n"
    "      --replay LOG      make the decisions of a recorded run again, which LOG has of\n"
    "                        lcm-logger or the like; needs no --config\n"
    "      --replay-clock    the same from lcm-logplayer on the bus; answers on channels named\n"
    "                        REPLAY_...\n"
    "      --verify          compare what is replayed with what was recorded\n"
    "      --model FILE      a model that the recorded run began with or loaded (may be "
    "repeated)\n"
    "      --help-options    list every option of the configuration\n"
    "      --version         print the version\n"
    "  -h, --help            print this\n\n"
    "Exit status: 0 ended as asked, 1 could not start or run, or a replay differs, 2 wrong "
    "usage.\n";

enum {
    OPTION_NO_RT = 256,
    OPTION_CHECK_MODEL,
    OPTION_REPLAY,
    OPTION_REPLAY_CLOCK,
    OPTION_VERIFY,
    OPTION_MODEL,
    OPTION_HELP_OPTIONS,
    OPTION_VERSION
};

static int wrong_usage(const char *what)
{
    fprintf(stderr, "reachd: %s; reachd --help tells more\n", what);
    return 2;
}

static int go_on_unless(const char *wrong)
{
    return wrong ? wrong_usage(wrong) : -1;
}

static int add_model(struct arguments *arguments)
{
    if (arguments->n_models == MAX_MODELS)
        return wrong_usage("too many --model");
    arguments->models[arguments->n_models++] = optarg;
    return -1;
}

/* Options that are asked for, not given. */
static int print(int option)
{
    if (option == OPTION_HELP_OPTIONS)
        config_print_options(stdout);
    else if (option == OPTION_VERSION)
        printf("reachd %s\n", reach_version);
    else
        fputs(usage, stdout);
    return 0;
}

/* Returns -1 to go on, or an exit status. */
static int take_option(struct arguments *arguments, int option)
{
    bool *flag = option == 'l'                   ? &arguments->lockstep
                 : option == 'v'                 ? &arguments->verbose
                 : option == OPTION_NO_RT        ? &arguments->no_rt
                 : option == OPTION_CHECK_MODEL  ? &arguments->check_model
                 : option == OPTION_REPLAY_CLOCK ? &arguments->replay_clock
                 : option == OPTION_VERIFY       ? &arguments->verify
                                                 : NULL;

    if (flag) {
        *flag = true;
        return -1;
    }
    switch (option) {
    case 'c':
        return go_on_unless(option_sources_add_path(&arguments->configuration, optarg));
    case 's':
        return go_on_unless(option_sources_add_override(&arguments->configuration, optarg));
    case OPTION_MODEL:
        return add_model(arguments);
    case 'u':
        arguments->url = optarg;
        return -1;
    case OPTION_REPLAY:
        arguments->replay = optarg;
        return -1;
    case OPTION_HELP_OPTIONS:
    case OPTION_VERSION:
    case 'h':
        return print(option);
    default:
        return wrong_usage("unknown option or missing value");
    }
}

/* What goes together. */
static int check(const struct arguments *arguments)
{
    bool replays = arguments->replay || arguments->replay_clock;

    if (arguments->replay && arguments->replay_clock)
        return wrong_usage("--replay reads a log, --replay-clock the bus: one of them is wanted");
    if (!replays && (arguments->verify || arguments->n_models > 0))
        return wrong_usage("--verify and --model belong to --replay or --replay-clock");
    if (replays && (arguments->lockstep || arguments->check_model))
        return wrong_usage("--lockstep and --check-model do not go with a replay");
    if (arguments->configuration.n_paths == 0 &&
        (!replays || arguments->configuration.n_overrides > 0))
        return wrong_usage("--config is missing");
    return -1;
}

int arguments_parse(struct arguments *arguments, int argc, char **argv)
{
    static const struct option words[] = {
        {"config", required_argument, NULL, 'c'},
        {"set", required_argument, NULL, 's'},
        {"url", required_argument, NULL, 'u'},
        {"lockstep", no_argument, NULL, 'l'},
        {"no-rt", no_argument, NULL, OPTION_NO_RT},
        {"check-model", no_argument, NULL, OPTION_CHECK_MODEL},
        {"replay", required_argument, NULL, OPTION_REPLAY},
        {"replay-clock", no_argument, NULL, OPTION_REPLAY_CLOCK},
        {"verify", no_argument, NULL, OPTION_VERIFY},
        {"model", required_argument, NULL, OPTION_MODEL},
        {"verbose", no_argument, NULL, 'v'},
        {"help-options", no_argument, NULL, OPTION_HELP_OPTIONS},
        {"version", no_argument, NULL, OPTION_VERSION},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, "c:s:u:lvh", words, NULL)) != -1) {
        int status = take_option(arguments, option);
        if (status >= 0)
            return status;
    }
    if (optind < argc)
        return wrong_usage("unexpected argument");
    return check(arguments);
}
