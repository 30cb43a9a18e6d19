#include "fake_lcm.h"

#include <lcm/lcm.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define MOST_SUBSCRIPTIONS 16
#define RAW 0x80u

struct _lcm_subscription_t {
    const char *channel;
    lcm_msg_handler_t handler;
    void *user;
};

static lcm_subscription_t subscriptions[MOST_SUBSCRIPTIONS];
static size_t n_subscriptions;

lcm_t *lcm_create(const char *url)
{
    static int somewhere;

    (void)url;
    return (lcm_t *)&somewhere;
}

void lcm_destroy(lcm_t *lcm)
{
    (void)lcm;
    n_subscriptions = 0;
}

lcm_subscription_t *lcm_subscribe(lcm_t *lcm, const char *channel, lcm_msg_handler_t handler,
                                  void *user)
{
    (void)lcm;
    if (n_subscriptions == MOST_SUBSCRIPTIONS)
        abort();
    subscriptions[n_subscriptions] = (lcm_subscription_t){channel, handler, user};
    return &subscriptions[n_subscriptions++];
}

int lcm_unsubscribe(lcm_t *lcm, lcm_subscription_t *subscription)
{
    (void)lcm;
    *subscription = subscriptions[--n_subscriptions];
    return 0;
}

int lcm_subscription_set_queue_capacity(lcm_subscription_t *subscription, int messages)
{
    (void)subscription;
    (void)messages;
    return 0;
}

int lcm_publish(lcm_t *lcm, const char *channel, const void *data, unsigned int size)
{
    (void)lcm;
    fake_lcm_deliver(channel, (const uint8_t *)data, size);
    return 0;
}

int lcm_handle_timeout(lcm_t *lcm, int milliseconds)
{
    (void)lcm;
    (void)milliseconds;
    return 0;
}

void fake_lcm_deliver(const char *channel, const uint8_t *data, size_t size)
{
    /* A copy of exactly this size: reading past the end is then seen. */
    uint8_t *copy = (uint8_t *)malloc(size ? size : 1);
    lcm_recv_buf_t message = {.data = copy, .data_size = (uint32_t)size};

    if (!copy)
        abort();
    if (size)
        memcpy(copy, data, size);
    for (size_t i = 0; i < n_subscriptions; i++)
        if (strcmp(subscriptions[i].channel, channel) == 0)
            subscriptions[i].handler(&message, channel, subscriptions[i].user);
    free(copy);
}

static size_t deliver_raw(const struct fake_lcm_channel *channel, const uint8_t *data, size_t size)
{
    size_t length = size > 0 ? data[0] : 0;

    if (size > 0 && length > size - 1)
        length = size - 1;
    fake_lcm_deliver(channel->name, size > 0 ? data + 1 : data, length);
    return size > 0 ? 1 + length : 0;
}

static size_t deliver_whole(const struct fake_lcm_channel *channel, const uint8_t *data,
                            size_t size)
{
    uint8_t message[8 + FAKE_LCM_MOST] = {0};
    size_t length = size < channel->encoded_size ? size : channel->encoded_size;

    if (channel->encoded_size > FAKE_LCM_MOST)
        abort();
    for (int i = 0; i < 8; i++)
        message[i] = (uint8_t)((uint64_t)channel->fingerprint >> (56 - 8 * i));
    if (length)
        memcpy(message + 8, data, length);
    fake_lcm_deliver(channel->name, message, 8 + channel->encoded_size);
    return length;
}

size_t fake_lcm_deliver_next(const struct fake_lcm_channel *channels, size_t n_channels,
                             const uint8_t *data, size_t size)
{
    const struct fake_lcm_channel *channel = &channels[(data[0] & ~RAW) % n_channels];
    bool raw = data[0] & RAW;

    return 1 + (raw ? deliver_raw : deliver_whole)(channel, data + 1, size - 1);
}
