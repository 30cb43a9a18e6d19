#include "vision/ball/eyes.h"

#include <algorithm>

static const int64_t set_back = 1000000; /* us */

void eyes_init(eyes *who, const eyes_config &config)
{
    *who = eyes();
    who->config = config;
    who->work.range = config.colour;
    who->work.colours = colour_table_create(config.colour);
    who->work.limits = config.limits;
    who->tags = tag_finder_create(config.tag);
}

static void look_with(eyes *who, const image_view &image, const camera &eye,
                      const image_region &part, int step, eye_findings *seen)
{
    if (who->tags.dictionary) {
        seen->n_found =
            tag_find(&who->tags, image, eye, part, seen->found, seen->refused, &seen->n_refused);
        return;
    }
    seen->n_found = segment_find(&who->work, image, eye, part, step, seen->found);
    seen->n_refused = who->work.n_refused;
    std::copy(who->work.refused, who->work.refused + seen->n_refused, seen->refused);
}

static stereo_marker look_in(eyes *who, const image_view &left, const image_region &left_part,
                             const image_view &right, const image_region &right_part, int step)
{
    const stereo_rig &rig = who->config.rig;
    eye_findings &in_left = who->in_left;
    eye_findings &in_right = who->in_right;
    int i = 0;
    int j = 0;

    look_with(who, right, rig.right, right_part, step, &in_right);
    in_left.n_found = in_left.n_refused = 0;
    if (in_right.n_found > 0)
        look_with(who, left, rig.left, left_part, step, &in_left);
    const stereo_marker marker =
        stereo_match(rig, in_left.found, in_left.n_found, in_right.found, in_right.n_found, &i, &j);
    if (marker.reason == STEREO_SEEN) {
        who->left_blob = in_left.found[i];
        who->right_blob = in_right.found[j];
    }
    return marker;
}

/* Returns true when windows settled it. */
static bool look_in_windows(eyes *who, int64_t utime, const image_view &left,
                            const image_view &right, stereo_marker *marker)
{
    image_region left_part;
    image_region right_part;

    if (who->in_windows >= who->config.recheck ||
        !track_predict(who->left, who->config.window, utime, &left_part) ||
        !track_predict(who->right, who->config.window, utime, &right_part))
        return false;
    *marker = look_in(who, left, left_part, right, right_part, who->config.window_step);
    return marker->reason == STEREO_SEEN;
}

static void forget(eyes *who)
{
    who->left = track();
    who->right = track();
    who->newest = 0;
    who->in_windows = 0;
}

stereo_marker eyes_look(eyes *who, int64_t utime, const image_view &left, const image_view &right)
{
    stereo_marker marker;

    if (who->newest - utime > set_back)
        forget(who);
    const bool late = utime <= who->newest;
    who->used_window = !late && look_in_windows(who, utime, left, right, &marker);
    if (!who->used_window)
        marker = look_in(who, left, image_whole(left), right, image_whole(right),
                         who->config.whole_step);
    if (late)
        return marker;
    who->newest = utime;
    who->in_windows = who->used_window ? who->in_windows + 1 : 0;
    if (marker.reason == STEREO_SEEN) {
        track_saw(&who->left, utime, who->left_blob.pixel, who->left_blob.radius);
        track_saw(&who->right, utime, who->right_blob.pixel, who->right_blob.radius);
    }
    return marker;
}
