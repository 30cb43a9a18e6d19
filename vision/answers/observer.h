/* What happens to a pair from its arrival to its marker: answer from memory, pass over what is too
 * old, decode, look, remember, count. */
#ifndef VISION_ANSWERS_OBSERVER_H
#define VISION_ANSWERS_OBSERVER_H

#include <reach_marker_t.h>

#include "vision/answers/answers.h"
#include "vision/answers/doubts.h"
#include "vision/answers/statistics.h"
#include "vision/ball/eyes.h"
#include "vision/pictures/decode.h"
#include "vision/pictures/source.h"

/* Where markers go. */
class marker_receiver
{
public:
    virtual ~marker_receiver() = default;
    virtual void publish(const reach_marker_t &marker) = 0;
    /* A pair was looked at; both pictures are there until this returns. */
    virtual void show(const image_view &left, const image_view &right, const eyes &who,
                      const reach_marker_t &marker) = 0;
};

class observer : public pair_receiver
{
public:
    /* `drop_after_us`: live pairs that waited longer are passed over, 0 = never. The receiver must
     * outlive the observer. */
    observer(const eyes_config &config, int64_t drop_after_us, marker_receiver *receiver);

    void take(const incoming_pair &pair) override;
    void refuse(const char *reason) override;

    const statistics &counts() const
    {
        return counts_;
    }

private:
    bool too_old(const incoming_pair &pair) const;
    bool too_far_apart(const image_message &images) const;
    bool decode(const image_message &images, image_view *left, image_view *right);
    void look(const image_message &images, reach_marker_t *marker);
    void count_unseen(const stereo_marker &found);
    void complain(const char *what, const char *reason);

    eyes eyes_;
    decoder left_;
    decoder right_;
    answers answers_;
    statistics counts_;
    doubts doubts_;
    marker_receiver *receiver_;
    int64_t drop_after_us_;
    int64_t seq_ = 0;
    int64_t complained_at_ = 0; /* monotonic us */
};

#endif
