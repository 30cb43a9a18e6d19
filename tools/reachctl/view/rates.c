#include "tools/reachctl/view/rates.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const int64_t window_us = 1000000;

/* The channel's row, put in where its name belongs; NULL when there is no room. */
static struct rate *row(struct rates *rates, const char *channel)
{
    int i = 0;
    int order = 1;

    while (i < rates->n && (order = strcmp(rates->rate[i].channel, channel)) < 0)
        i++;
    if (i < rates->n && order == 0)
        return &rates->rate[i];
    if (rates->n == RATES_MOST)
        return NULL;
    memmove(&rates->rate[i + 1], &rates->rate[i], (size_t)(rates->n - i) * sizeof rates->rate[0]);
    rates->n++;
    rates->rate[i] = (struct rate){0};
    snprintf(rates->rate[i].channel, sizeof rates->rate[i].channel, "%s", channel);
    return &rates->rate[i];
}

static void count_interval(struct rate *rate, int64_t interval)
{
    rate->intervals++;
    rate->sum += (double)interval;
    rate->squares += (double)interval * (double)interval;
    if (interval > rate->longest)
        rate->longest = interval;
}

void rates_count(struct rates *rates, const char *channel, const void *data, size_t bytes,
                 int64_t now)
{
    struct rate *rate = row(rates, channel);

    if (rates->opened == 0)
        rates->opened = now;
    if (!rate) {
        rates->uncounted++;
        return;
    }
    if (rate->last != 0)
        count_interval(rate, now - rate->last);
    rate->type = message_type_of(data, bytes);
    rate->last = now;
    rate->messages++;
    rate->bytes += (int64_t)bytes;
}

static double jitter_of(const struct rate *rate)
{
    double n = (double)rate->intervals;
    double mean = n > 0 ? rate->sum / n : 0;

    return n >= 2 ? sqrt(fmax(0, rate->squares / n - mean * mean)) : 0;
}

double rates_settle(struct rates *rates, int64_t now)
{
    double seconds = (double)(now - rates->opened) * 1e-6;

    if (rates->opened == 0 || now - rates->opened < window_us)
        return 0;
    for (int i = 0; i < rates->n; i++) {
        struct rate *rate = &rates->rate[i];
        rate->per_second = (double)rate->messages / seconds;
        rate->bytes_per_second = (double)rate->bytes / seconds;
        rate->jitter = jitter_of(rate);
        rate->messages = rate->bytes = rate->intervals = 0;
        rate->sum = rate->squares = 0;
    }
    rates->opened = now;
    return seconds;
}
