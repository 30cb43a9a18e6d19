#include <cstring>

#include "common/logs/event_log.h"
#include "common/program/log.h"
#include "vision/pictures/source.h"

namespace
{
class log_source : public source
{
public:
    log_source(const char *channel, pair_receiver *receiver)
        : channel_(channel), receiver_(receiver)
    {
    }

    ~log_source() override
    {
        if (log_)
            event_log_close(log_);
    }

    bool open(const char *path, char *error, size_t error_size)
    {
        log_ = event_log_open(path, EVENT_LOG_KEEP_ALL, error, error_size);
        return log_;
    }

    source_state poll(int) override
    {
        char error[512];
        event one;
        const int got = event_log_next(log_, &one, error, sizeof error);

        if (got < 0)
            log_error("%s", error);
        else if (got > 0 && strcmp(one.channel, channel_) == 0)
            hand_over(one);
        return got < 0 ? SOURCE_FAILED : got > 0 ? SOURCE_OPEN : SOURCE_ENDED;
    }

private:
    void hand_over(const event &one)
    {
        incoming_pair pair;

        pair.waited = 0;
        const char *wrong = one.data ? image_message_parse(one.data, one.size, &pair.images)
                                     : "larger than any message of LCM";
        if (wrong)
            receiver_->refuse(wrong);
        else
            receiver_->take(pair);
    }

    const char *channel_;
    pair_receiver *receiver_;
    event_log *log_ = nullptr;
};
} // namespace

std::unique_ptr<source> source_log(const char *path, const char *channel, pair_receiver *receiver,
                                   char *error, size_t error_size)
{
    std::unique_ptr<log_source> made(new log_source(channel, receiver));

    if (made->open(path, error, error_size))
        return made;
    return nullptr;
}
