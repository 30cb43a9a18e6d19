/* A log that is to be replayed: as it is, and with its checksums made right again, so that what was
 * damaged gets as far as the control step. What comes out is finite, and a refusal has a reason. */
#include "common/base/checksum.h"
#include "common/logs/event_log.h"
#include "daemon/bus/outgoing.h"
#include "daemon/replay/player.h"
#include "harness.h"

#include <math.h>
#include <reach_config_t.h>
#include <string.h>

enum { CONFIG_CHECKSUM_AT = 24, CONFIG_TEXT_AT = CONFIG_CHECKSUM_AT + 4 + 48 };

static void check_outputs(void *user, struct tick_outputs *outputs)
{
    (void)user;
    for (int i = 0; outputs->has_command && i < 16; i++)
        HARNESS_REQUIRE(isfinite(outputs->command.velocity[i]));
}

static void put_word(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(word >> (24 - 8 * i));
}

/* As somebody would who knows how checksums are made. */
static void make_right(const char *channel, unsigned char *data, size_t size)
{
    size_t covered = outgoing_trace_covered();

    if (strcmp(channel, "REACH_TRACE") == 0 && size == covered + 4)
        put_word(data + covered, checksum_crc32(data, covered));
    if (strcmp(channel, "REACH_CONFIG") == 0 && size > CONFIG_TEXT_AT) {
        size_t most = size - CONFIG_TEXT_AT;
        size_t length = strnlen((const char *)data + CONFIG_TEXT_AT, most);
        put_word(data + CONFIG_CHECKSUM_AT, checksum_crc32(data + CONFIG_TEXT_AT, length));
    }
}

static void replay_made_right(const char *path)
{
    const struct replay_settings settings = {.verify = true, .lossy = true, .sink = check_outputs};
    struct replay *replay = replay_create(&settings);
    static unsigned char message[EVENT_LOG_KEEP_OURS];
    struct event event;
    char error[512] = "";
    struct event_log *log = event_log_open(path, EVENT_LOG_KEEP_OURS, error, sizeof error);

    HARNESS_REQUIRE(replay && log);
    while (event_log_next(log, &event, error, sizeof error) > 0) {
        if (!event.data)
            continue;
        memcpy(message, event.data, event.size);
        make_right(event.channel, message, event.size);
        if (replay_take(replay, event.channel, message, event.size, event.position, error,
                        sizeof error))
            HARNESS_REQUIRE(error[0] && !strchr(error, '\n'));
    }
    event_log_close(log);
    replay_destroy(replay);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const struct replay_settings settings = {.verify = true};
    const char *path = harness_file(data, size);
    char error[512] = "";

    if (player_play_log(&path, 1, &settings, error, sizeof error))
        HARNESS_REQUIRE(error[0] && !strchr(error, '\n'));
    replay_made_right(path);
    return 0;
}
