/* reach-learner: options, and the order of start and end. */
#include "learner/service/server.h"

#include "common/bus/open.h"
#include "common/options/command_line.h"
#include "common/program/log.h"
#include "common/program/version.h"

#include <getopt.h>
#include <reach_hello_t.h>
#include <stdio.h>
#include <string.h>

static const int claim_ms = 300; /* time for another service to answer */

struct arguments {
    struct option_sources configuration;
    const char *url;
    bool check_model;
};

static const char usage[] =
    "usage: reach-learner --config FILE [options]\n"
    "Learns, for others on the LCM bus, a map that may have several values: "
    "docs/learner-service.md.\n\n"
    "  -c, --config FILE     YAML configuration, such as etc/reach-learner.yaml; given again, the\n"
    "                        later file overrides the earlier one\n"
    "  -s, --set NAME=VALUE  override one option of it (may be repeated)\n"
    "  -u, --url URL         LCM bus (default $LCM_DEFAULT_URL, else " BUS_DEFAULT_URL ")\n"
    "      --check-model     print the samples and the hash of the model in model.directory, or "
    "what\n"
    "                        is wrong with it, and change nothing\n"
    "      --help-options    list every option of the configuration\n"
    "      --version         print the version\n"
    "  -h, --help            print this\n\n"
    "Exit status: 0 ended as asked, 1 could not start or run, 2 wrong usage.\n";

enum { OPTION_CHECK_MODEL = 256, OPTION_HELP_OPTIONS, OPTION_VERSION };

static int wrong_usage(const char *what)
{
    fprintf(stderr, "reach-learner: %s; reach-learner --help tells more\n", what);
    return 2;
}

static int go_on_unless(const char *wrong)
{
    return wrong ? wrong_usage(wrong) : -1;
}

/* Returns -1 to go on, or an exit status. */
static int take_option(struct arguments *arguments, int option)
{
    switch (option) {
    case 'c':
        return go_on_unless(option_sources_add_path(&arguments->configuration, optarg));
    case 's':
        return go_on_unless(option_sources_add_override(&arguments->configuration, optarg));
    case 'u':
        arguments->url = optarg;
        return -1;
    case OPTION_CHECK_MODEL:
        arguments->check_model = true;
        return -1;
    case OPTION_HELP_OPTIONS:
        settings_print(stdout);
        return 0;
    case OPTION_VERSION:
        printf("reach-learner %s\n", reach_version);
        return 0;
    case 'h':
        fputs(usage, stdout);
        return 0;
    default:
        return wrong_usage("unknown option or missing value");
    }
}

static int parse(struct arguments *arguments, int argc, char **argv)
{
    static const struct option words[] = {
        {"config", required_argument, NULL, 'c'},
        {"set", required_argument, NULL, 's'},
        {"url", required_argument, NULL, 'u'},
        {"check-model", no_argument, NULL, OPTION_CHECK_MODEL},
        {"help-options", no_argument, NULL, OPTION_HELP_OPTIONS},
        {"version", no_argument, NULL, OPTION_VERSION},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, "c:s:u:h", words, NULL)) != -1) {
        int status = take_option(arguments, option);
        if (status >= 0)
            return status;
    }
    if (optind < argc)
        return wrong_usage("unexpected argument");
    if (arguments->configuration.n_paths == 0)
        return wrong_usage("--config is missing");
    return -1;
}

static int check_model(const struct settings *settings, char *error, size_t error_size)
{
    const struct model_store_settings store = settings_store(settings);

    if (model_store_check(&store, error, error_size))
        return -1;
    puts(error);
    return 0;
}

/* Another service on this bus would answer the same requests. */
static int serve_on_bus(const struct arguments *arguments, const struct settings *settings,
                        char *error, size_t error_size)
{
    struct bus_claim *claim = NULL;
    lcm_t *lcm = bus_open(arguments->url, error, error_size);
    int result = -1;

    if (!lcm)
        return -1;
    switch (bus_claim_role(lcm, REACH_HELLO_T_LEARNER, claim_ms, &claim)) {
    case 0:
        result = server_run(settings, lcm, error, error_size);
        break;
    case 1:
        snprintf(error, error_size,
                 "another reach-learner is on this bus; end it first, or use --url");
        break;
    default:
        snprintf(error, error_size, "the bus failed");
        break;
    }
    lcm_destroy(lcm);
    bus_claim_free(claim);
    return result;
}

int main(int argc, char **argv)
{
    struct arguments arguments = {0};
    struct settings settings;
    char error[1024] = "";
    int status = parse(&arguments, argc, argv);

    if (status >= 0)
        return status;
    log_open("reach-learner", LOG_LEVEL_INFO);
    status = settings_load(&settings, arguments.configuration.paths,
                           arguments.configuration.n_paths, arguments.configuration.overrides,
                           arguments.configuration.n_overrides, error, sizeof error) ||
             (arguments.check_model ? check_model(&settings, error, sizeof error)
                                    : serve_on_bus(&arguments, &settings, error, sizeof error));
    if (status)
        log_error("%s", error);
    return status ? 1 : 0;
}
