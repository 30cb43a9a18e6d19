#include <cstdio>

#include "common/bus/open.h"
#include "vision/pictures/source.h"

/* In lockstep at most the pair in work and one or two behind it exist; real-time pairs that pile up
 * beyond this many are old anyway, and each raw one holds 1.8 MB. */
static const int queue_length = 16;

namespace
{
class bus_source : public source
{
public:
    bus_source(lcm_t *lcm, pair_receiver *receiver) : lcm_(lcm), receiver_(receiver) {}

    ~bus_source() override
    {
        if (subscription_)
            lcm_unsubscribe(lcm_, subscription_);
    }

    bool subscribe(const char *channel)
    {
        subscription_ = lcm_subscribe(lcm_, channel, on_images, this);
        return subscription_ &&
               lcm_subscription_set_queue_capacity(subscription_, queue_length) == 0;
    }

    source_state poll(int milliseconds) override
    {
        return lcm_handle_timeout(lcm_, milliseconds) < 0 ? SOURCE_FAILED : SOURCE_OPEN;
    }

private:
    static void on_images(const lcm_recv_buf_t *message, const char *, void *user)
    {
        const bus_source *self = static_cast<bus_source *>(user);
        incoming_pair pair;

        const char *wrong = image_message_parse(static_cast<const uint8_t *>(message->data),
                                                message->data_size, &pair.images);
        pair.waited = bus_utime() - message->recv_utime;
        if (wrong)
            self->receiver_->refuse(wrong);
        else
            self->receiver_->take(pair);
    }

    lcm_t *lcm_;
    pair_receiver *receiver_;
    lcm_subscription_t *subscription_ = nullptr;
};
} // namespace

std::unique_ptr<source> source_bus(lcm_t *lcm, const char *channel, pair_receiver *receiver,
                                   char *error, size_t error_size)
{
    std::unique_ptr<bus_source> made(new bus_source(lcm, receiver));

    if (made->subscribe(channel))
        return made;
    snprintf(error, error_size, "LCM refuses a subscription to %s", channel);
    return nullptr;
}
