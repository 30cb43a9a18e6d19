#include "vision/answers/observer.h"

#include <cstdlib>

#include "common/bus/open.h"
#include "common/program/log.h"

static const int64_t live_within = 10000000;     /* us */
static const int64_t complaint_period = 1000000; /* us */

observer::observer(const eyes_config &config, int64_t drop_after_us, marker_receiver *receiver)
    : left_(config.tag.dictionary > 0), right_(config.tag.dictionary > 0), receiver_(receiver),
      drop_after_us_(drop_after_us)
{
    eyes_init(&eyes_, config);
}

/* A flood of bad pictures must not become a flood of lines. */
void observer::complain(const char *what, const char *reason)
{
    const int64_t now = bus_monotonic_us();

    if (complained_at_ != 0 && now - complained_at_ < complaint_period)
        return;
    complained_at_ = now;
    log_warning("%s: %s", what, reason);
}

void observer::refuse(const char *reason)
{
    counts_.malformed++;
    complain("image message dropped", reason);
}

/* In lockstep every pair counts and stamps are far from the present; in real time a marker that
 * comes late is worth less than the next one in time. */
bool observer::too_old(const incoming_pair &pair) const
{
    return drop_after_us_ > 0 && pair.waited > drop_after_us_ &&
           std::llabs(bus_utime() - pair.images.utime) < live_within;
}

/* Whether the eyes' own stamps, where there are any, are of one exposure. */
bool observer::too_far_apart(const image_message &images) const
{
    const int64_t most = eyes_.config.most_apart;

    return most > 0 && images.left.utime > 0 && images.right.utime > 0 &&
           std::llabs(images.left.utime - images.right.utime) > most;
}

bool observer::decode(const image_message &images, image_view *left, image_view *right)
{
    const double start = statistics_thread_us();
    const char *wrong = right_.decode(images.right, eyes_.config.rig.right, right);

    if (too_far_apart(images))
        wrong = "the eyes' stamps are further apart than eyes.most_apart";
    if (!wrong)
        wrong = left_.decode(images.left, eyes_.config.rig.left, left);
    time_histogram_add(&counts_.decode, statistics_thread_us() - start);
    if (wrong)
        complain("image unusable", wrong);
    return !wrong;
}

/* Of the eye that did not see it. */
void observer::count_unseen(const stereo_marker &found)
{
    if (found.reason != STEREO_NOT_IN_RIGHT && found.reason != STEREO_NOT_IN_LEFT)
        return;
    const eye_findings &seen = found.reason == STEREO_NOT_IN_RIGHT ? eyes_.in_right : eyes_.in_left;
    if (seen.n_refused == 0 && eyes_.tags.dictionary)
        counts_.faults[BLOB_NO_TAG]++;
    else if (seen.n_refused == 0)
        counts_.no_colour++;
    else
        counts_.faults[seen.refused[0].fault]++;
}

void observer::look(const image_message &images, reach_marker_t *marker)
{
    image_view left;
    image_view right;

    if (!decode(images, &left, &right)) {
        marker->reason = STEREO_UNUSABLE;
        return;
    }
    const double start = statistics_thread_us();
    const stereo_marker found = eyes_look(&eyes_, images.utime, left, right);
    marker->compute_us = statistics_thread_us() - start;
    time_histogram_add(&counts_.look, marker->compute_us);
    counts_.windows += eyes_.used_window;
    count_unseen(found);
    const bool grey =
        found.reason == STEREO_NOT_IN_RIGHT && !eyes_.tags.dictionary && doubts_colourless(right);
    const char *const doubt = doubts_add(&doubts_, images, found, grey);
    if (doubt)
        complain("in doubt", doubt);
    marker->seen = found.reason == STEREO_SEEN;
    marker->reason = static_cast<int8_t>(found.reason);
    marker->u_right = found.u_right;
    marker->v_right = found.v_right;
    marker->disparity = found.disparity;
    marker->radius = found.radius;
    receiver_->show(left, right, eyes_, *marker);
}

void observer::take(const incoming_pair &pair)
{
    const uint64_t content = answers_content(pair.images);
    const reach_marker_t *known = answers_find(answers_, pair.images.utime, content);
    reach_marker_t marker = {};

    if (known) {
        counts_.repeated++;
        receiver_->publish(*known);
        return;
    }
    marker.utime = pair.images.utime;
    marker.seq = ++seq_;
    if (too_old(pair)) {
        counts_.dropped++;
        return;
    }
    look(pair.images, &marker);
    counts_.pairs++;
    counts_.reasons[marker.reason]++;
    answers_keep(&answers_, content, marker);
    receiver_->publish(marker);
}
