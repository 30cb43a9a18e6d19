/* reachd: options, and the order of start and end. */
#include "arena.h"
#include "config.h"
#include "daemon_bus.h"
#include "house.h"
#include "keeper.h"
#include "loop.h"
#include "realtime.h"
#include "tick.h"
#include "watchdog.h"

#include "common/bus.h"
#include "common/log.h"
#include "common/version.h"

#include <getopt.h>
#include <reach_hello_t.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define MAX_CONFIGS 8
#define MAX_OVERRIDES 64

static const int claim_ms = 300; /* time for another daemon to answer */

struct arguments {
    const char *configs[MAX_CONFIGS];
    int n_configs;
    const char *url;
    const char *overrides[MAX_OVERRIDES];
    int n_overrides;
    bool lockstep, no_rt, check_model, verbose;
};

/* Everything that lives from start to end. */
struct reachd {
    struct arguments arguments;
    struct config config;
    struct reload reload;
    lcm_t *lcm;
    struct bus_claim *claim;
    struct arena *arena;
    struct tick *tick;
    struct daemon_bus *bus;
    struct watchdog *watchdog;
    struct loop *loop;
    struct keeper keeper;
};

static const char usage[] =
    "usage: reachd --config FILE [options]\n"
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
    "      --help-options    list every option of the configuration\n"
    "      --version         print the version\n"
    "  -h, --help            print this\n\n"
    "Exit status: 0 ended as asked, 1 could not start or run, 2 wrong usage.\n";

enum { OPTION_NO_RT = 256, OPTION_CHECK_MODEL, OPTION_HELP_OPTIONS, OPTION_VERSION };

static int wrong_usage(const char *what)
{
    fprintf(stderr, "reachd: %s; reachd --help tells more\n", what);
    return 2;
}

/* Returns -1 to go on, or an exit status. */
static int take_option(struct arguments *arguments, int option)
{
    switch (option) {
    case 'c':
        if (arguments->n_configs == MAX_CONFIGS)
            return wrong_usage("too many --config");
        arguments->configs[arguments->n_configs++] = optarg;
        return -1;
    case 's':
        if (arguments->n_overrides == MAX_OVERRIDES)
            return wrong_usage("too many --set");
        arguments->overrides[arguments->n_overrides++] = optarg;
        return -1;
    case 'u':
        arguments->url = optarg;
        return -1;
    case 'l':
        arguments->lockstep = true;
        return -1;
    case 'v':
        arguments->verbose = true;
        return -1;
    case OPTION_NO_RT:
        arguments->no_rt = true;
        return -1;
    case OPTION_CHECK_MODEL:
        arguments->check_model = true;
        return -1;
    case OPTION_HELP_OPTIONS:
        config_print_options(stdout);
        return 0;
    case OPTION_VERSION:
        printf("reachd %s\n", reach_version);
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
        {"lockstep", no_argument, NULL, 'l'},
        {"no-rt", no_argument, NULL, OPTION_NO_RT},
        {"check-model", no_argument, NULL, OPTION_CHECK_MODEL},
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
    if (arguments->n_configs == 0)
        return wrong_usage("--config is missing");
    return -1;
}

static bool is_real_time(const struct reachd *reachd)
{
    return !reachd->arguments.lockstep && !reachd->arguments.no_rt;
}

/* LCM starts a thread here, which inherits the priority: messages must not wait in it. */
static int open_bus(struct reachd *reachd, char *error, size_t error_size)
{
    bool real_time = is_real_time(reachd);

    realtime_limit_memory();
    if (real_time && realtime_enter(REALTIME_PRIORITY_BUS, error, error_size))
        return -1;
    reachd->lcm = bus_open(reachd->arguments.url, error, error_size);
    if (!reachd->lcm)
        return -1;
    return real_time ? realtime_enter(0, error, error_size) : 0;
}

/* Another daemon on this bus would steer the same robot. */
static int claim_bus(struct reachd *reachd, char *error, size_t error_size)
{
    if (open_bus(reachd, error, error_size))
        return -1;
    switch (bus_claim_role(reachd->lcm, REACH_HELLO_T_DAEMON, claim_ms, &reachd->claim)) {
    case 0:
        return 0;
    case 1:
        snprintf(error, error_size, "another reachd is on this bus; end it first, or use --url");
        return -1;
    default:
        snprintf(error, error_size, "the bus failed");
        return -1;
    }
}

static int check_model_directory(const struct config *config, char *error, size_t error_size)
{
    struct stat status;

    if (!config->model_directory[0])
        return 0;
    if (stat(config->model_directory, &status) == 0 && S_ISDIR(status.st_mode))
        return 0;
    snprintf(error, error_size, "model.directory: %s is not a directory; make it first",
             config->model_directory);
    return -1;
}

/* All memory of the loop, in one piece. */
static int build(struct reachd *reachd, char *error, size_t error_size)
{
    bool lockstep = reachd->arguments.lockstep;
    bool real_time = is_real_time(reachd);

    reachd->arena = arena_create(tick_memory(&reachd->config) + daemon_bus_memory() +
                                 watchdog_memory() + loop_memory());
    if (!reachd->arena) {
        snprintf(error, error_size, "out of memory");
        return -1;
    }
    reachd->tick = tick_create(&reachd->config, reachd->arena, error, error_size);
    if (!reachd->tick || tick_open_model(reachd->tick, error, error_size))
        return -1;
    reachd->bus =
        daemon_bus_create(reachd->lcm, reachd->config.space.kind, reachd->arena, error, error_size);
    if (!reachd->bus)
        return -1;
    reachd->watchdog = watchdog_create(&reachd->config, reachd->bus, !lockstep, reachd->arena);
    reachd->loop = loop_create(&reachd->config, reachd->tick, reachd->bus, reachd->watchdog,
                               lockstep, real_time, reachd->arena);
    if (!reachd->watchdog || !reachd->loop) {
        snprintf(error, error_size, "out of memory");
        return -1;
    }
    log_info("%.1f MB for the loop, %s", (double)arena_used(reachd->arena) / 1e6,
             lockstep    ? "lockstep"
             : real_time ? "real time"
                         : "real time without priority");
    return 0;
}

static void tear_down(struct reachd *reachd)
{
    if (reachd->tick)
        model_store_close(tick_model_store(reachd->tick));
    if (reachd->lcm)
        lcm_destroy(reachd->lcm);
    bus_claim_free(reachd->claim);
    arena_destroy(reachd->arena);
}

static struct reload reload_of(const struct reachd *reachd)
{
    return (struct reload){.paths = reachd->arguments.configs,
                           .n_paths = reachd->arguments.n_configs,
                           .overrides = reachd->arguments.overrides,
                           .n_overrides = reachd->arguments.n_overrides,
                           .accepted = &reachd->config};
}

static int check_model(const struct config *config, char *error, size_t error_size)
{
    const struct model_store_settings settings = tick_store_settings(config);

    if (model_store_check(&settings, error, error_size))
        return -1;
    puts(error);
    return 0;
}

/* Bus, loop, watchdog: all or none. */
static int start_threads(struct reachd *reachd, char *error, size_t error_size)
{
    bool real_time = is_real_time(reachd);

    if (daemon_bus_start(reachd->bus, real_time, error, error_size))
        return -1;
    if (loop_start(reachd->loop, error, error_size)) {
        daemon_bus_stop(reachd->bus);
        return -1;
    }
    if (watchdog_start(reachd->watchdog, real_time, error, error_size)) {
        loop_stop(reachd->loop);
        daemon_bus_stop(reachd->bus);
        return -1;
    }
    return 0;
}

/* The model's thread ends last, and after the arm has stopped: its disk may be slow. */
static void stop_threads(struct reachd *reachd)
{
    watchdog_stop(reachd->watchdog);
    loop_stop(reachd->loop);
    daemon_bus_stop(reachd->bus);
}

static int keep_model(struct reachd *reachd, char *error, size_t error_size)
{
    struct model_store *store = tick_model_store(reachd->tick);

    if (is_real_time(reachd))
        model_store_unlock_memory(store);
    if (keeper_start(&reachd->keeper, store, error, error_size) == 0)
        return 0;
    stop_threads(reachd);
    return -1;
}

static int run(struct reachd *reachd, char *error, size_t error_size)
{
    struct house house = {0};

    reachd->reload = reload_of(reachd);
    house_take_signals();
    watchdog_take_signal();
    if (claim_bus(reachd, error, error_size) || build(reachd, error, error_size) ||
        start_threads(reachd, error, error_size) || keep_model(reachd, error, error_size))
        return -1;
    log_info("ready");
    house.loop = reachd->loop;
    house.bus = reachd->bus;
    house.reload = &reachd->reload;
    house_keep(&house);
    stop_threads(reachd);
    keeper_stop(&reachd->keeper);
    log_info("ended after %lld ticks", (long long)loop_ticks(reachd->loop));
    return 0;
}

int main(int argc, char **argv)
{
    static struct reachd reachd;
    char error[512] = "";
    int status = parse(&reachd.arguments, argc, argv);

    if (status >= 0)
        return status;
    log_open("reachd", reachd.arguments.verbose ? LOG_LEVEL_DEBUG : LOG_LEVEL_INFO);
    status = config_load(&reachd.config, reachd.arguments.configs, reachd.arguments.n_configs,
                         reachd.arguments.overrides, reachd.arguments.n_overrides, error,
                         sizeof error) ||
             check_model_directory(&reachd.config, error, sizeof error) ||
             (reachd.arguments.check_model ? check_model(&reachd.config, error, sizeof error)
                                           : run(&reachd, error, sizeof error));
    if (status)
        log_error("%s", error);
    tear_down(&reachd);
    return status ? 1 : 0;
}
