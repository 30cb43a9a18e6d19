#include "tools/log/survey.h"

#include "common/base/big_endian.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FINGERPRINT = 8, SEQ_AT = 16 }; /* in a message of ours */

/* Where the channel is, or belongs. */
static size_t place_of(const struct survey *survey, const char *name, bool *there)
{
    size_t low = 0, high = survey->n_channels;

    *there = false;
    while (low < high) {
        size_t middle = (low + high) / 2;
        int order = strcmp(survey->channel[middle].name, name);
        if (order == 0) {
            *there = true;
            return middle;
        }
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static int make_room(struct survey *survey)
{
    size_t room = survey->room ? 2 * survey->room : 32;
    struct survey_channel *channel;

    if (survey->n_channels < survey->room)
        return 0;
    channel = realloc(survey->channel, room * sizeof *channel);
    if (!channel)
        return -1;
    survey->channel = channel;
    survey->room = room;
    return 0;
}

static uint64_t fingerprint_of(const struct event *event)
{
    return event->data && event->size >= FINGERPRINT ? big_endian(event->data, FINGERPRINT) : 0;
}

/* The event's channel; NULL when there is no memory. */
static struct survey_channel *channel_of(struct survey *survey, const struct event *event)
{
    bool there;
    size_t i = place_of(survey, event->channel, &there);
    struct survey_channel *channel;

    if (there)
        return &survey->channel[i];
    if (make_room(survey))
        return NULL;
    channel = &survey->channel[i];
    memmove(channel + 1, channel, (survey->n_channels - i) * sizeof *channel);
    survey->n_channels++;
    *channel = (struct survey_channel){.name = strdup(event->channel),
                                       .type = message_type_of(event->data, event->size),
                                       .fingerprint = fingerprint_of(event),
                                       .first = event->stamp,
                                       .last = event->stamp,
                                       .seq = INT64_MIN};
    return channel->name ? channel : NULL;
}

static void count_message(struct survey_channel *channel, const struct event *event)
{
    int64_t pause = (int64_t)((uint64_t)event->stamp - (uint64_t)channel->last);

    if (pause > channel->pause)
        channel->pause = pause;
    channel->last = event->stamp;
    channel->messages++;
    channel->bytes += (int64_t)event->size;
    if (fingerprint_of(event) != channel->fingerprint)
        channel->mixed = true;
    else if (channel->type && event->size >= SEQ_AT + 8) {
        int64_t seq = (int64_t)big_endian(event->data + SEQ_AT, 8);
        channel->restarts += seq < channel->seq;
        channel->seq = seq;
    }
}

static void count_gap(struct survey *survey, const struct event *event)
{
    if (event->skipped == 0)
        return;
    if (survey->gaps < SURVEY_GAPS)
        survey->gap[survey->gaps] =
            (struct survey_gap){event->position - event->skipped, event->skipped};
    survey->gaps++;
    survey->skipped += event->skipped;
}

static int count_event(struct survey *survey, const struct event *event)
{
    struct survey_channel *channel = channel_of(survey, event);

    if (!channel)
        return -1;
    count_message(channel, event);
    if (survey->events++ == 0)
        survey->first = survey->last = event->stamp;
    else if (event->stamp < survey->newest)
        survey->turned_back++;
    survey->newest = event->stamp;
    survey->first = event->stamp < survey->first ? event->stamp : survey->first;
    survey->last = event->stamp > survey->last ? event->stamp : survey->last;
    return 0;
}

int survey_read(struct survey *survey, struct event_log *log, char *error, size_t error_size)
{
    struct event event;
    int result;

    while ((result = event_log_next(log, &event, error, error_size)) > 0) {
        count_gap(survey, &event);
        if (count_event(survey, &event)) {
            snprintf(error, error_size, "out of memory");
            return -1;
        }
    }
    if (result < 0)
        return -1;
    count_gap(survey, &event);
    survey->torn = event.skipped > 0;
    survey->bytes = event.position;
    return 0;
}

void survey_free(struct survey *survey)
{
    for (size_t i = 0; i < survey->n_channels; i++)
        free(survey->channel[i].name);
    free(survey->channel);
}

int64_t survey_runs(const struct survey *survey)
{
    static const char *const numbered[] = {"REACH_TRACE", "REACH_STATUS"};
    bool there;

    for (size_t i = 0; i < sizeof numbered / sizeof numbered[0]; i++) {
        size_t at = place_of(survey, numbered[i], &there);
        if (there && survey->channel[at].type)
            return 1 + survey->channel[at].restarts;
    }
    return 0;
}
