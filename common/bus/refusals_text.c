#include "common/bus/refusals_text.h"

#include <assert.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

enum { CHANNELS = REACH_STATUS_T_CHANNEL_OUT + 1, REASONS = REACH_STATUS_T_JUMP + 1 };

static_assert(sizeof((reach_status_t *)0)->refused / sizeof(int64_t) == CHANNELS * REASONS,
              "the status has a count for each");

static const char *const reasons[REASONS] = {"malformed", "a value is out of range",
                                             "of another time", "more than there is room for",
                                             "a joint jumps"};

static const char *channel_name(const reach_status_t *status, int channel)
{
    static const char *const names[CHANNELS] = {"ROBOT_STATE", "MARKER", "REACH_REQUEST",
                                                "REACH_BODY", "messages of reachd's own"};

    if (channel == REACH_STATUS_T_CHANNEL_SENSE && status->space == REACH_STATUS_T_CARTESIAN)
        return "END_EFFECTOR";
    return names[channel];
}

struct text {
    char *at;
    size_t size, length;
};

static void add(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add(struct text *text, const char *format, ...)
{
    va_list arguments;
    int n;

    va_start(arguments, format);
    n = vsnprintf(text->at + text->length, text->size - text->length, format, arguments);
    va_end(arguments);
    text->length += n > 0 ? (size_t)n : 0;
    if (text->length >= text->size)
        text->length = text->size - 1;
}

static void add_state(struct text *text, const reach_status_t *now)
{
    add(text, "; state %lld: ", (long long)now->refused_state);
    if (now->refused_joint > 0)
        add(text, "joint %d is at %.4g, which must be within %.4g .. %.4g", now->refused_joint,
            now->refused_value, now->refused_min, now->refused_max);
    else
        add(text, "another number of joints, or no number or time of its own");
}

void refusals_text(const reach_status_t *now, const reach_status_t *before, char *text, size_t size)
{
    struct text out = {text, size, 0};

    text[0] = '\0';
    for (int channel = 0; channel < CHANNELS; channel++)
        for (int reason = 0; reason < REASONS; reason++) {
            int64_t n =
                now->refused[channel][reason] - (before ? before->refused[channel][reason] : 0);
            if (n > 0)
                add(&out, "%s%lld %s (%s)", out.length ? ", " : "", (long long)n,
                    channel_name(now, channel), reasons[reason]);
        }
    if (out.length && now->refused_state != (before ? before->refused_state : 0))
        add_state(&out, now);
}
