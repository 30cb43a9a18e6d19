#include "daemon/replay/player.h"

#include "common/bus/open.h"
#include "common/program/log.h"
#include "common/program/printable.h"
#include "common/program/version.h"
#include "daemon/bus/outgoing.h"
#include "daemon/replay/pieces.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const int poll_ms = 100;  /* how soon a signal is seen */
static const int queue = 100000; /* messages that may wait for us; LCM drops the newest beyond it */

static void say_revision(const struct replay_report *report)
{
    char text[4 * sizeof report->revision + 1];

    if (report->revision[0] && strcmp(report->revision, reach_version) != 0)
        log_info("recorded by reachd %s, replayed by %s",
                 printable(report->revision, sizeof report->revision, text, sizeof text),
                 reach_version);
}

static void print_report(const struct replay_report *report, double wall, bool verified)
{
    printf("%lld ticks in %lld %s, %.1f s of robot time", (long long)report->ticks,
           (long long)report->runs, report->runs == 1 ? "run" : "runs", report->seconds);
    if (wall > 0)
        printf(", in %.2f s: %.0f times real time", wall, report->seconds / wall);
    puts(verified ? "; everything that was sent is the same to the byte" : "");
    if (report->repeated)
        printf("%lld REACH_TRACE were logged twice, and taken once\n", (long long)report->repeated);
    if (report->foreign)
        printf("%lld REACH_TRACE are of another version of reachd's messages, or of another "
               "program; they were left out\n",
               (long long)report->foreign);
}

/* The configurations first: they are said once a second, and the first tick may be before that. */
static int take_configs(struct pieces *pieces, struct replay *replay, char *error,
                        size_t error_size)
{
    const char *wanted = replay_channels[REPLAY_CONFIG];
    struct event event;
    int result;

    while ((result = pieces_next(pieces, &event, error, error_size)) > 0)
        if (result != PIECES_END_OF_ONE && event.data && strcmp(event.channel, wanted) == 0 &&
            replay_take(replay, event.channel, event.data, event.size, event.position, error,
                        error_size))
            return -1;
    pieces_rewind(pieces);
    return result;
}

/* Where a log is damaged, and how far it reaches when its logger was killed. */
static void say_skipped(const char *path, const struct event *event, bool at_end)
{
    long long from = (long long)(event->position - event->skipped);
    char name[512];

    if (event->skipped == 0)
        return;
    printable(path, strlen(path), name, sizeof name);
    if (at_end)
        log_warning("%s: the log ends within an event, at byte %lld; all before it was replayed",
                    name, from);
    else
        log_warning("%s: %lld bytes from byte %lld on are no event of an LCM log; they were left "
                    "out",
                    name, (long long)event->skipped, from);
}

/* A piece that has just ended. One that holds no event is no log, unless it is empty. */
static int end_piece(const struct pieces *pieces, const struct event *event, int64_t events,
                     char *error, size_t error_size)
{
    if (events == 0 && event->skipped > 0) {
        snprintf(error, error_size, "there is no event of an LCM log in it");
        return -1;
    }
    say_skipped(pieces_path(pieces), event, true);
    return 0;
}

static int replay_events(struct pieces *pieces, struct replay *replay, char *error,
                         size_t error_size)
{
    struct event event;
    int64_t events = 0; /* in this piece */
    int result;

    if (take_configs(pieces, replay, error, error_size))
        return -1;
    while ((result = pieces_next(pieces, &event, error, error_size)) > 0) {
        if (result == PIECES_END_OF_ONE) {
            if (end_piece(pieces, &event, events, error, error_size))
                return -1;
            events = 0;
            continue;
        }
        events++;
        say_skipped(pieces_path(pieces), &event, false);
        if (event.data && replay_take(replay, event.channel, event.data, event.size, event.position,
                                      error, error_size))
            return -1;
    }
    return result < 0 ? -1 : replay_end(replay, error, error_size);
}

int player_play_log(const char *const *paths, int n_paths, const struct replay_settings *settings,
                    char *error, size_t error_size)
{
    struct pieces *pieces = calloc(1, sizeof *pieces);
    struct replay *replay = replay_create(settings);
    int64_t begin = bus_monotonic_us();
    char reason[512], text[1024];
    int result = -1;

    snprintf(error, error_size, "out of memory");
    if (pieces && replay && pieces_open(pieces, paths, n_paths, error, error_size) == 0) {
        result = replay_events(pieces, replay, reason, sizeof reason);
        say_revision(replay_report(replay));
        if (result == 0)
            print_report(replay_report(replay), (double)(bus_monotonic_us() - begin) * 1e-6,
                         settings->verify);
        else
            snprintf(error, error_size, "%s: %s", pieces_path(pieces),
                     printable(reason, sizeof reason, text, sizeof text));
    }
    replay_destroy(replay);
    if (pieces)
        pieces_close(pieces);
    free(pieces);
    return result;
}

/* What is played on the bus. */
struct playing {
    struct replay *replay;
    struct outgoing_messages out;
    struct outgoing sending;
    bool failed;
    char error[512];
};

static void on_message(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    struct playing *playing = user;

    if (!playing->failed)
        playing->failed = replay_take(playing->replay, channel, message->data, message->data_size,
                                      0, playing->error, sizeof playing->error) != 0;
}

static void send_outputs(void *user, struct tick_outputs *outputs)
{
    struct playing *playing = user;
    struct outgoing *sending = &playing->sending;

    if (outputs->has_command) {
        *sending = (struct outgoing){.kind = OUTGOING_COMMAND, .command = outputs->command};
        outgoing_publish(&playing->out, sending);
    }
    if (outputs->has_sample) {
        *sending = (struct outgoing){.kind = OUTGOING_SAMPLE, .sample = outputs->sample};
        outgoing_publish(&playing->out, sending);
    }
    *sending = (struct outgoing){.kind = OUTGOING_STATUS, .status = outputs->status};
    outgoing_publish(&playing->out, sending);
    *sending = (struct outgoing){.kind = OUTGOING_TRACE, .trace = outputs->trace};
    outgoing_publish(&playing->out, sending);
}

static int subscribe(lcm_t *lcm, struct playing *playing)
{
    for (int i = 0; i < REPLAY_CHANNELS; i++) {
        lcm_subscription_t *one = lcm_subscribe(lcm, replay_channels[i], on_message, playing);
        if (!one || lcm_subscription_set_queue_capacity(one, queue))
            return -1;
    }
    return 0;
}

static bool told_to_end(void)
{
    const struct timespec at_once = {0};
    sigset_t signals;

    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return sigtimedwait(&signals, NULL, &at_once) > 0;
}

/* The runs whose losses are told by themselves. */
static int64_t told_runs(const struct replay_report *report)
{
    return report->runs < REPLAY_RUNS ? report->runs : REPLAY_RUNS;
}

static bool any_lost(const struct replay_report *report)
{
    for (int64_t run = 0; run < told_runs(report); run++)
        for (int i = 0; i < REPLAY_CHANNELS; i++)
            if (report->run[run].lost[i].n > 0)
                return true;
    return false;
}

static void print_lost(const struct replay_report *report)
{
    for (int64_t run = 0; run < told_runs(report); run++)
        for (int i = 0; i < REPLAY_CHANNELS; i++) {
            const struct replay_lost *lost = &report->run[run].lost[i];
            if (lost->n == 0)
                continue;
            if (report->runs > 1)
                printf("run %lld: ", (long long)run + 1);
            printf("lost: %lld %s, the first %lld\n", (long long)lost->n, replay_channels[i],
                   (long long)lost->first);
        }
}

static int play_until_told(lcm_t *lcm, struct playing *playing)
{
    while (!playing->failed && !told_to_end())
        if (lcm_handle_timeout(lcm, poll_ms) < 0 && errno != EINTR)
            return -1;
    return playing->failed ? -1 : 0;
}

int player_play_bus(lcm_t *lcm, const struct replay_settings *settings, char *error,
                    size_t error_size)
{
    struct playing *playing = calloc(1, sizeof *playing);
    struct replay_settings ours = *settings;
    int result = -1;

    ours.lossy = true;
    ours.sink = send_outputs;
    ours.user = playing;
    if (playing && (playing->replay = replay_create(&ours)) != NULL) {
        outgoing_init(&playing->out, lcm, "REPLAY_");
        snprintf(playing->error, sizeof playing->error, "the bus failed");
        log_info("ready for lcm-logplayer");
        result = subscribe(lcm, playing) ? -1 : play_until_told(lcm, playing);
        say_revision(replay_report(playing->replay));
        print_report(replay_report(playing->replay), 0,
                     settings->verify && result == 0 && !any_lost(replay_report(playing->replay)));
        print_lost(replay_report(playing->replay));
        snprintf(error, error_size, "%s", playing->error);
        replay_destroy(playing->replay);
    } else
        snprintf(error, error_size, "out of memory");
    free(playing);
    return result;
}
