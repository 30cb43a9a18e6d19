/* reachctl: talks to the daemon, and to the simulator for the experimenter. */
#include "common/bus/open.h"
#include "common/logs/event_log.h"
#include "common/options/command_line.h"
#include "tools/reachctl/body/show.h"
#include "tools/reachctl/client.h"
#include "tools/reachctl/command.h"
#include "tools/reachctl/doctor/doctor.h"
#include "tools/reachctl/motors/hearing.h"
#include "tools/reachctl/outcome.h"
#include "tools/reachctl/view/echo.h"
#include "tools/reachctl/view/show.h"
#include "tools/reachctl/view/top.h"

#include <errno.h>
#include <libgen.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct arguments {
    struct command_settings settings;
    struct command_words words; /* the command and its own arguments */
};

static const struct argument_row rows[] = {
    ARGUMENT_URL(struct arguments, settings.url),
    ARGUMENT_SECONDS("timeout", "S", struct arguments, settings.timeout,
                     "wait this long for an answer; default 5"),
    ARGUMENT_ON("wait", 0, struct arguments, settings.wait, "until what was asked for has ended"),
    ARGUMENT_ON("json", 0, struct arguments, settings.json, "status or doctor as JSON"),
    ARGUMENT_ON("once", 0, struct arguments, settings.once,
                "top: one frame, then the end; echo: one message"),
    ARGUMENT_INT64("seed", "S", struct arguments, settings.seed, INT64_MIN, INT64_MAX,
                   "of random configurations and goals; default 1"),
    ARGUMENT_ON("frozen", 0, struct arguments, settings.frozen,
                "use the model without teaching it"),
    ARGUMENT_TEXT("file", 0, "F", struct arguments, settings.file,
                  "targets of coordinate, lines 'u v disparity' in pixels"),
    ARGUMENT_TEXT("urdf", 0, "FILE", struct arguments, settings.urdf,
                  "body: write it there as a URDF"),
    ARGUMENT_ON("dh", 0, struct arguments, settings.dh,
                "body: as numbers of Denavit and Hartenberg"),
    ARGUMENT_SECONDS("period", "S", struct arguments, settings.period, "time for each target"),
    ARGUMENT_END,
};

static int take_word(void *user, const char *text, char *error, size_t error_size)
{
    return command_words_take(&((struct arguments *)user)->words, text, error, error_size);
}

static const struct command_line line = {
    .program = "reachctl",
    .usage = "reachctl [OPTIONS] COMMAND [ARGUMENTS]",
    .about = "Talks to the daemon, and to the simulator for the experimenter.",
    .rows = rows,
    .exit_status = "0 done, 1 refused, failed or no answer",
    .print_more = command_print_help,
    .take_word = take_word,
};

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

static int write_urdf(const struct body *body, const char *path, char *error, size_t error_size)
{
    FILE *file;

    if (event_log_begins(path)) {
        snprintf(error, error_size, "%s: is a log, and is not overwritten", path);
        return -1;
    }
    file = fopen(path, "w");
    if (file)
        body_write_urdf(body, file);
    if (!file || ferror(file) || fclose(file) != 0) {
        snprintf(error, error_size, "%s: %s", path, strerror(errno));
        return -1;
    }
    return 0;
}

static int show_body_in_use(struct client *client, const struct call *call,
                            const struct command_settings *settings, char *error, size_t error_size)
{
    static struct body body;

    if (client_ask_body(client, &call->request, settings->timeout, &body, error, error_size))
        return -1;
    if (settings->urdf)
        return write_urdf(&body, settings->urdf, error, error_size);
    if (settings->dh)
        body_write_dh(&body, stdout);
    else
        body_show(&body, stdout);
    return 0;
}

/* What was heard is judged, too, when one of the joints has made the daemon stop. */
static int check_motors(struct client *client, reach_request_t *request, double timeout,
                        char *error, size_t error_size)
{
    struct motors_hearing *hearing = motors_listen(client_bus(client));
    int result = -1;
    int bad;

    if (!hearing) {
        snprintf(error, error_size, "out of memory");
        return -1;
    }
    if (client_ask_daemon(client, request, timeout, error, error_size) == 0)
        result = client_follow(client, request, timeout, error, error_size);
    bad = motors_print(hearing);
    motors_end(hearing);
    if (result || bad == 0)
        return result;
    snprintf(error, error_size, "%d %s not well; see docs/howto/robot-driver.md", bad,
             bad == 1 ? "joint is" : "joints are");
    return -1;
}

/* Somebody who means pixels and says metres is told before the arm stretches. */
static void question(struct client *client, const reach_request_t *request, double timeout)
{
    const reach_status_t *status = client_status(client, timeout);
    char why[200];

    if (status && outcome_doubtful(status, request, why, sizeof why))
        fprintf(stderr, "reachctl: %s; the robot tries it all the same\n", why);
}

static int ask_daemon(struct client *client, struct call *call,
                      const struct command_settings *settings, char *error, size_t error_size)
{
    if (call->request.kind == REACH_REQUEST_T_REACH)
        question(client, &call->request, settings->timeout);
    if (client_ask_daemon(client, &call->request, settings->timeout, error, error_size))
        return -1;
    if (call->request.kind == REACH_REQUEST_T_RESET_FAULT)
        return client_await_recovery(client, settings->timeout, error, error_size);
    return settings->wait
               ? client_follow(client, &call->request, settings->timeout, error, error_size)
               : 0;
}

/* What needs somebody who answers. */
static int ask(struct client *client, struct call *call, const struct command_settings *settings,
               char *error, size_t error_size)
{
    switch (call->kind) {
    case CALL_STATUS:
        return show_status(client, settings, error, error_size);
    case CALL_BODY:
        return show_body_in_use(client, call, settings, error, error_size);
    case CALL_DAEMON:
        return ask_daemon(client, call, settings, error, error_size);
    case CALL_MOTORS:
        return check_motors(client, &call->request, settings->timeout, error, error_size);
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
    if (call->kind == CALL_ECHO)
        return echo_run(settings->url, call->channel, settings->once, settings->timeout, error,
                        error_size);
    client = client_create(settings->url, error, error_size);
    if (!client)
        return -1;
    result = ask(client, call, settings, error, error_size);
    client_destroy(client);
    return result;
}

/* A command that is a program of its own, beside this one or on PATH.
 *   returns only where it cannot be started */
static int hand_over(char **argv)
{
    static const char program[] = "reach-new-robot";
    char self[PATH_MAX] = "", path[PATH_MAX + sizeof program];

    if (readlink("/proc/self/exe", self, sizeof self - 1) > 0) {
        snprintf(path, sizeof path, "%s/%s", dirname(self), program);
        execv(path, argv + 1);
    }
    execvp(program, argv + 1);
    fprintf(stderr, "reachctl: %s: %s; in the source tree ./run new-robot does it\n", program,
            strerror(errno));
    return EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    struct arguments arguments = {0};
    struct command_settings *settings = &arguments.settings;
    struct call call = {0};
    char error[512] = "the bus failed";
    int status;

    if (argc > 1 && strcmp(argv[1], "new-robot") == 0)
        return hand_over(argv);
    command_defaults(settings);
    status = command_line_parse(&line, argc, argv, &arguments);
    if (status >= 0)
        return status;
    if (command_parse(arguments.words.word, arguments.words.n, settings, &call, error,
                      sizeof error))
        return command_line_wrong(&line, "%s", error);
    if (carry_out(&call, settings, error, sizeof error) == 0)
        return EXIT_SUCCESS;
    fprintf(stderr, "reachctl: %s\n", error);
    return EXIT_FAILURE;
}
