#include "daemon/replay/player.h"

#include "common/bus/open.h"
#include "common/options/regular_file.h"
#include "common/program/log.h"
#include "common/program/version.h"
#include "daemon/bus/outgoing.h"
#include "daemon/replay/event_log.h"

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
    if (report->revision[0] && strcmp(report->revision, reach_version) != 0)
        log_info("recorded by reachd %s, replayed by %s", report->revision, reach_version);
}

static void print_report(const struct replay_report *report, double wall, bool verified)
{
    printf("%lld ticks in %lld %s, %.1f s of robot time", (long long)report->ticks,
           (long long)report->runs, report->runs == 1 ? "run" : "runs", report->seconds);
    if (wall > 0)
        printf(", in %.2f s: %.0f times real time", wall, report->seconds / wall);
    puts(verified ? "; everything that was sent is the same to the byte" : "");
}

/* The configurations first: they are said once a second, and the first tick may be before that. */
static int take_configs(struct event_log *log, struct replay *replay, char *error,
                        size_t error_size)
{
    const char *wanted = replay_channels[REPLAY_CONFIG];
    struct event event;

    while (event_log_next(log, &event, error, error_size) > 0)
        if (event.data && strcmp(event.channel, wanted) == 0 &&
            replay_take(replay, event.channel, event.data, event.size, event.position, error,
                        error_size))
            return -1;
    /* What is wrong with the log is said where the replay comes to it. */
    rewind(log->file);
    log->position = 0;
    return 0;
}

static int replay_events(struct event_log *log, struct replay *replay, char *error,
                         size_t error_size)
{
    struct event event;
    int result;

    if (take_configs(log, replay, error, error_size))
        return -1;
    while ((result = event_log_next(log, &event, error, error_size)) > 0)
        if (event.data && replay_take(replay, event.channel, event.data, event.size, event.position,
                                      error, error_size))
            return -1;
    if (result == 0 && replay_report(replay)->ticks == 0) {
        snprintf(error, error_size, "there is no REACH_TRACE in it, so there is nothing to replay");
        return -1;
    }
    return result;
}

static int replay_file(FILE *file, const struct replay_settings *settings, char *error,
                       size_t error_size)
{
    struct event_log *log = calloc(1, sizeof *log);
    struct replay *replay = replay_create(settings);
    int64_t begin = bus_monotonic_us();
    int result = -1;

    if (log && replay) {
        log->file = file;
        result = replay_events(log, replay, error, error_size);
        say_revision(replay_report(replay));
        if (result == 0)
            print_report(replay_report(replay), (double)(bus_monotonic_us() - begin) * 1e-6,
                         settings->verify);
    } else
        snprintf(error, error_size, "out of memory");
    replay_destroy(replay);
    free(log);
    return result;
}

int player_play_log(const char *path, const struct replay_settings *settings, char *error,
                    size_t error_size)
{
    FILE *file = regular_file_open(path, error, error_size);
    char reason[512];
    int result;

    if (!file)
        return -1;
    result = replay_file(file, settings, reason, sizeof reason);
    if (result)
        snprintf(error, error_size, "%s: %s", path, reason);
    fclose(file);
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

static bool any_lost(const struct replay_report *report)
{
    for (int i = 0; i < REPLAY_CHANNELS; i++)
        if (report->lost[i].n > 0)
            return true;
    return false;
}

static void print_lost(const struct replay_report *report)
{
    for (int i = 0; i < REPLAY_CHANNELS; i++)
        if (report->lost[i].n > 0)
            printf("lost: %lld %s, the first %lld\n", (long long)report->lost[i].n,
                   replay_channels[i], (long long)report->lost[i].first);
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
