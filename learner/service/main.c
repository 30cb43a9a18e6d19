/* reach-learner: options, and the order of start and end. */
#include "learner/service/server.h"

#include "common/bus/open.h"
#include "common/options/command_line.h"
#include "common/program/log.h"

#include <reach_hello_t.h>
#include <stdio.h>
#include <string.h>

struct arguments {
    struct option_sources configuration;
    const char *url;
    bool check_model;
};

static const struct argument_row rows[] = {
    ARGUMENT_SOURCES(struct arguments, configuration, "etc/reach-learner.yaml"),
    ARGUMENT_URL(struct arguments, url),
    ARGUMENT_ON("check-model", 0, struct arguments, check_model,
                "print the samples and the hash of the model in model.directory, or what is wrong "
                "with it, and change nothing"),
    ARGUMENT_END,
};

static const struct command_line line = {
    .program = "reach-learner",
    .usage = "reach-learner --config FILE [options]",
    .about = "Learns, for others on the LCM bus, a map that may have several values: "
             "docs/learner-service.md.",
    .rows = rows,
    .exit_status = "0 ended as asked, 1 could not start or run",
    .print_options = settings_print,
};

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
    if (bus_claim_alone(lcm, REACH_HELLO_T_LEARNER, "reach-learner", &claim, error, error_size) ==
        0)
        result = server_run(settings, lcm, error, error_size);
    lcm_destroy(lcm);
    bus_claim_free(claim);
    return result;
}

int main(int argc, char **argv)
{
    struct arguments arguments = {0};
    struct settings settings;
    char error[1024] = "";
    int status = command_line_parse(&line, argc, argv, &arguments);

    if (status < 0 && arguments.configuration.n_paths == 0)
        status = command_line_wrong(&line, "--config is missing");
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
