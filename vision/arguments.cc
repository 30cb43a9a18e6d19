#include "vision/arguments.h"

#include <getopt.h>

#include <cerrno>
#include <cstdio>

#include "common/program/version.h"
#include "vision/config.h"

static const char usage[] =
    "usage: reach-vision [--config FILE] [--set NAME=VALUE]... [--url URL] [--stats FILE] "
    "[--show]\n"
    "                    [--cameras LEFT RIGHT | --videos LEFT RIGHT | --bench PAIR [--draw "
    "FILE]]\n"
    "\n"
    "Finds the ball in pairs of pictures and says where it is on channel MARKER.\n"
    "Pairs come from channel STEREO_IMAGES unless cameras or videos are named.\n"
    "\n"
    "  -c, --config FILE         options, YAML (such as etc/vision-kobian.yaml)\n"
    "  -s, --set NAME=VALUE      one option more; may be repeated\n"
    "  -u, --url URL             LCM bus; default $LCM_DEFAULT_URL, else this machine's own\n"
    "      --show                a window with both pictures and what was found\n"
    "      --cameras LEFT RIGHT  two V4L2 devices\n"
    "      --videos LEFT RIGHT   two video files; ends with them\n"
    "      --stats FILE          counts and times at the end, JSON\n"
    "      --bench PAIR          no bus: find the ball in one stored pair (pictures side by side)\n"
    "                            and measure the time it takes\n"
    "      --draw FILE           with --bench: write the pair with what was found\n"
    "      --help-options        every option with unit, default and range\n"
    "  -h, --help                this text\n"
    "  -V, --version             version and git revision\n"
    "\n"
    "Exit codes: 0 ended as asked, 1 failure, 2 wrong usage.\n";

static int wrong_usage(const char *what)
{
    fprintf(stderr, "reach-vision: %s; reach-vision --help tells more\n", what);
    return 2;
}

/* Options with two values: getopt gives the first, the second is the next word. */
static bool take_two(arguments *given, int argc, char **argv)
{
    given->left = optarg;
    if (optind >= argc || argv[optind][0] == '-')
        return false;
    given->right = argv[optind++];
    return true;
}

enum { OPT_SHOW = 256, OPT_CAMERAS, OPT_VIDEOS, OPT_STATS, OPT_BENCH, OPT_DRAW, OPT_HELP_OPTIONS };

static const struct option options[] = {
    {"config", required_argument, nullptr, 'c'},
    {"set", required_argument, nullptr, 's'},
    {"url", required_argument, nullptr, 'u'},
    {"show", no_argument, nullptr, OPT_SHOW},
    {"cameras", required_argument, nullptr, OPT_CAMERAS},
    {"videos", required_argument, nullptr, OPT_VIDEOS},
    {"stats", required_argument, nullptr, OPT_STATS},
    {"bench", required_argument, nullptr, OPT_BENCH},
    {"draw", required_argument, nullptr, OPT_DRAW},
    {"help-options", no_argument, nullptr, OPT_HELP_OPTIONS},
    {"help", no_argument, nullptr, 'h'},
    {"version", no_argument, nullptr, 'V'},
    {nullptr, 0, nullptr, 0},
};

/* Options that only leave a value behind. */
static bool keep_value(int letter, arguments *given)
{
    switch (letter) {
    case 'c':
        given->config = optarg;
        return true;
    case 's':
        given->overrides.push_back(optarg);
        return true;
    case 'u':
        given->url = optarg;
        return true;
    case OPT_SHOW:
        given->show = true;
        return true;
    case OPT_STATS:
        given->stats = optarg;
        return true;
    case OPT_BENCH:
        given->bench = optarg;
        return true;
    case OPT_DRAW:
        given->draw = optarg;
        return true;
    default:
        return false;
    }
}

int arguments_parse(int argc, char **argv, arguments *given)
{
    int letter;

    argv[0] = program_invocation_short_name; /* what getopt puts in front of its complaints */
    while ((letter = getopt_long(argc, argv, "c:s:u:hV", options, nullptr)) != -1) {
        if (keep_value(letter, given))
            continue;
        if (letter == OPT_HELP_OPTIONS)
            config_print(stdout);
        else if (letter == 'h')
            fputs(usage, stdout);
        else if (letter == 'V')
            printf("reach-vision %s\n", reach_version);
        if (letter != OPT_CAMERAS && letter != OPT_VIDEOS)
            return letter == '?' ? 2 : 0;
        given->cameras |= letter == OPT_CAMERAS;
        given->videos |= letter == OPT_VIDEOS;
        if (!take_two(given, argc, argv))
            return wrong_usage("--cameras and --videos want two names, left and right");
    }
    if (optind < argc)
        return wrong_usage("a word too many");
    if (given->cameras + given->videos + (given->bench != nullptr) > 1)
        return wrong_usage("--cameras, --videos and --bench exclude each other");
    if (given->draw && !given->bench)
        return wrong_usage("--draw goes with --bench");
    return -1;
}
