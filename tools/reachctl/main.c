/* reachctl: talks to the daemon, and to the simulator for the experimenter. */
#include "common/program/version.h"
#include "tools/reachctl/client.h"
#include "tools/reachctl/command.h"
#include "tools/reachctl/doctor/doctor.h"
#include "tools/reachctl/show.h"
#include "tools/reachctl/top.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_USAGE = 2, MAX_WORDS = 8 };

static const char usage[] =
    "usage: reachctl [OPTIONS] COMMAND [ARGUMENTS]\n"
    "\n"
    "  --url URL       LCM bus; default $LCM_DEFAULT_URL, else this machine's own\n"
    "  --timeout S     wait this long for an answer; default 5\n"
    "  --wait          until what was asked for has ended\n"
    "  --json          status or doctor as JSON\n"
    "  --once          top: one frame, then the end\n"
    "  --seed S        of random configurations and goals; default 1\n"
    "  --frozen        use the model without teaching it\n"
    "  --file F        targets of coordinate, lines 'u v disparity' in pixels\n"
    "  --period S      time for each target\n"
    "  -h, --help      this text\n"
    "  -V, --version   version and git revision\n"
    "\n"
    "exit code: 0 done, 1 refused, failed or no answer, 2 wrong usage\n"
    "\n";

enum long_option {
    OPTION_URL = 256,
    OPTION_TIMEOUT,
    OPTION_WAIT,
    OPTION_JSON,
    OPTION_ONCE,
    OPTION_SEED,
    OPTION_FROZEN,
    OPTION_FILE,
    OPTION_PERIOD
};

static const struct option long_options[] = {{"url", required_argument, NULL, OPTION_URL},
                                             {"timeout", required_argument, NULL, OPTION_TIMEOUT},
                                             {"wait", no_argument, NULL, OPTION_WAIT},
                                             {"json", no_argument, NULL, OPTION_JSON},
                                             {"once", no_argument, NULL, OPTION_ONCE},
                                             {"seed", required_argument, NULL, OPTION_SEED},
                                             {"frozen", no_argument, NULL, OPTION_FROZEN},
                                             {"file", required_argument, NULL, OPTION_FILE},
                                             {"period", required_argument, NULL, OPTION_PERIOD},
                                             {"help", no_argument, NULL, 'h'},
                                             {"version", no_argument, NULL, 'V'},
                                             {0}};

struct words {
    int n;
    const char *text[MAX_WORDS];
};

static int wrong_usage(const char *reason)
{
    fprintf(stderr, "reachctl: %s\n", reason);
    return EXIT_USAGE;
}

/* A positive number of seconds. Returns 0 or EXIT_USAGE. */
static int seconds(const char *text, double *value)
{
    char *end;

    *value = strtod(text, &end);
    return end == text || *end || !(*value > 0 && *value < 1e6)
               ? wrong_usage("a positive number of seconds is wanted")
               : 0;
}

static int whole(const char *text, int64_t *value)
{
    char *end;

    *value = strtoll(text, &end, 10);
    return end == text || *end ? wrong_usage("--seed: a whole number is wanted") : 0;
}

/* Returns 0 to go on, EXIT_USAGE, or -1 when everything was said. */
static int take_option(int option, struct command_settings *settings)
{
    switch (option) {
    case OPTION_URL:
        settings->url = optarg;
        return 0;
    case OPTION_TIMEOUT:
        return seconds(optarg, &settings->timeout);
    case OPTION_WAIT:
        settings->wait = true;
        return 0;
    case OPTION_JSON:
        settings->json = true;
        return 0;
    case OPTION_ONCE:
        settings->once = true;
        return 0;
    case OPTION_SEED:
        return whole(optarg, &settings->seed);
    case OPTION_FROZEN:
        settings->frozen = true;
        return 0;
    case OPTION_FILE:
        settings->file = optarg;
        return 0;
    case OPTION_PERIOD:
        return seconds(optarg, &settings->period);
    case 'h':
        fputs(usage, stdout);
        command_print_help(stdout);
        return -1;
    case 'V':
        printf("reachctl %s\n", reach_version);
        return -1;
    default:
        return EXIT_USAGE; /* getopt has said why */
    }
}

/* "-50" is a number, not an option. */
static bool is_word(const char *text)
{
    char *end;

    strtod(text, &end);
    return text[0] != '-' || (*text && *end == '\0');
}

static int read_command_line(int argc, char **argv, struct command_settings *settings,
                             struct words *words)
{
    int result = 0;

    while (optind < argc && result == 0) {
        if (is_word(argv[optind])) {
            if (words->n == MAX_WORDS)
                return wrong_usage("too many arguments");
            words->text[words->n++] = argv[optind++];
        } else {
            int option = getopt_long(argc, argv, "+hV", long_options, NULL);
            if (option != -1)
                result = take_option(option, settings);
        }
    }
    return result;
}

static int show_status(struct client *client, const struct command_settings *settings, char *error,
                       size_t error_size)
{
    const reach_status_t *status = client_status(client, settings->timeout);

    if (!status) {
        snprintf(error, error_size,
                 "no status from reachd in %g s: it does not run, or no robot state reaches it",
                 settings->timeout);
        return -1;
    }
    if (settings->json)
        show_json(status, stdout);
    else
        show_text(status, stdout);
    return 0;
}

/* What needs somebody who answers. */
static int ask(struct client *client, struct call *call, const struct command_settings *settings,
               char *error, size_t error_size)
{
    switch (call->kind) {
    case CALL_STATUS:
        return show_status(client, settings, error, error_size);
    case CALL_DAEMON:
        if (client_ask_daemon(client, &call->request, settings->timeout, error, error_size))
            return -1;
        return settings->wait
                   ? client_follow(client, &call->request, settings->timeout, error, error_size)
                   : 0;
    case CALL_SIMULATOR:
        return client_ask_simulator(client, &call->sim, settings->timeout, error, error_size);
    case CALL_UNANSWERED:
        return client_tell_simulator(client, &call->sim);
    default:
        return -1;
    }
}

static int carry_out(struct call *call, const struct command_settings *settings, char *error,
                     size_t error_size)
{
    struct client *client;
    int result;

    if (call->kind == CALL_TOP)
        return top_run(settings->url, settings->once, settings->timeout, error, error_size);
    if (call->kind == CALL_DOCTOR)
        return doctor_run(settings->url, settings->json, error, error_size);
    client = client_create(settings->url, error, error_size);
    if (!client)
        return -1;
    result = ask(client, call, settings, error, error_size);
    client_destroy(client);
    return result;
}

int main(int argc, char **argv)
{
    struct command_settings settings;
    struct words words = {0};
    struct call call = {0};
    char error[512] = "the bus failed";
    int result;

    argv[0] = program_invocation_short_name; /* what getopt puts in front of its complaints */
    command_defaults(&settings);
    result = read_command_line(argc, argv, &settings, &words);
    if (result)
        return result < 0 ? EXIT_SUCCESS : result;
    if (command_parse(words.text, words.n, &settings, &call, error, sizeof error))
        return wrong_usage(error);
    result = carry_out(&call, &settings, error, sizeof error);
    if (result)
        fprintf(stderr, "reachctl: %s\n", error);
    return result ? EXIT_FAILURE : EXIT_SUCCESS;
}
