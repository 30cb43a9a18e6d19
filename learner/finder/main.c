/* reach-finder: waits for requests, searches, answers. It remembers nothing that a request does not
 * bring, so that it may be ended and started at any time. */
#include "common/bus/open.h"
#include "common/options/command_line.h"
#include "common/program/log.h"
#include "common/program/notify.h"
#include "learner/bus/body_message.h"
#include "learner/finder/bus.h"
#include "learner/finder/finder.h"

#include <errno.h>
#include <reach_hello_t.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct arguments {
    const char *url;
};

static const struct argument_row rows[] = {
    ARGUMENT_URL(struct arguments, url),
    ARGUMENT_END,
};

static const struct command_line line = {
    .program = "reach-finder",
    .usage = "reach-finder [options]",
    .about = "Finds a robot's body from the samples that reachd or reach-learner sends: "
             "docs/body.md.",
    .rows = rows,
    .exit_status = "0 ended as asked, 1 could not start or run",
};

static sem_t work;
static volatile sig_atomic_t end_asked;
static volatile sig_atomic_t searches; /* the main thread is in a search */

static void on_arrived(void)
{
    sem_post(&work);
}

/* A search may take seconds and nothing is lost with it. */
static void on_signal(int signal)
{
    (void)signal;
    if (searches)
        _exit(0);
    end_asked = 1;
    sem_post(&work);
}

static void take_signals(void)
{
    struct sigaction action = {.sa_handler = on_signal};

    sem_init(&work, 0, 0);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static double processor_seconds(void)
{
    struct timespec now = {0};

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void say(const reach_body_t *answer, const struct finder_report *report)
{
    log_info("search %lld: %s; %d starts, %.2f s", (long long)answer->seq, report->why,
             report->starts, answer->seconds);
}

static void search(struct finder_bus *bus, const struct question *question)
{
    static reach_body_t answer;
    static struct body body;
    static int done;
    struct finder_report report;
    double begin = processor_seconds();

    memset(&answer, 0, sizeof answer);
    searches = 1;
    answer.outcome = (int8_t)finder_search(&question->settings, question->contexts,
                                           question->n_contexts, &body, &report);
    searches = 0;
    body_message_put(report.any_body ? &body : NULL, &answer);
    answer.samples = report.samples;
    answer.starts = report.starts;
    answer.error = report.error;
    answer.doubt = report.doubt;
    answer.seconds = processor_seconds() - begin;
    memcpy(answer.why, report.why, sizeof answer.why);
    finder_bus_answer(bus, &answer);
    say(&answer, &report);
    done++;
    notify_send("STATUS=%d searches; the last one: %s", done, report.why);
}

static void serve(struct finder_bus *bus)
{
    notify_send("READY=1\nSTATUS=waiting for samples");
    log_info("ready");
    while (!end_asked) {
        struct question *question = finder_bus_take(bus);
        if (question)
            search(bus, question);
        else
            while (sem_wait(&work) && errno == EINTR && !end_asked)
                ;
        question_free(question);
    }
    notify_send("STOPPING=1");
}

static int serve_on_bus(lcm_t *lcm, char *error, size_t error_size)
{
    struct finder_bus *bus = finder_bus_create(lcm, on_arrived, error, error_size);

    if (!bus)
        return -1;
    if (finder_bus_start(bus, error, error_size))
        return -1;
    serve(bus);
    finder_bus_stop(bus);
    return 0;
}

static int run(const struct arguments *arguments, char *error, size_t error_size)
{
    struct bus_claim *claim = NULL;
    lcm_t *lcm = bus_open(arguments->url, error, error_size);
    int result = -1;

    if (!lcm)
        return -1;
    if (bus_claim_alone(lcm, REACH_HELLO_T_FINDER, "reach-finder", &claim, error, error_size) == 0)
        result = serve_on_bus(lcm, error, error_size);
    lcm_destroy(lcm);
    bus_claim_free(claim);
    return result;
}

int main(int argc, char **argv)
{
    struct arguments arguments = {0};
    char error[512] = "";
    int status = command_line_parse(&line, argc, argv, &arguments);

    if (status >= 0)
        return status;
    log_open("reach-finder", LOG_LEVEL_INFO);
    take_signals();
    status = run(&arguments, error, sizeof error);
    if (status)
        log_error("%s", error);
    return status ? 1 : 0;
}
