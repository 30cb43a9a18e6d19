#include "vision/ball/eyes.h"

static const int64_t set_back = 1000000; /* us */

void eyes_init(eyes *who, const eyes_config &config)
{
    *who = eyes();
    who->config = config;
    who->work.range = config.colour;
    who->work.colours = colour_table_create(config.colour);
    who->work.limits = config.limits;
}

static stereo_marker look_in(eyes *who, const image_view &left, const image_region &left_part,
                             const image_view &right, const image_region &right_part, int step)
{
    const stereo_rig &rig = who->config.rig;
    blob in_left[SEGMENT_CANDIDATES];
    blob in_right[SEGMENT_CANDIDATES];
    int n_left = 0;
    int i = 0;
    int j = 0;

    const int n_right = segment_find(&who->work, right, rig.right, right_part, step, in_right);
    who->looked_left = n_right > 0;
    if (n_right > 0)
        n_left = segment_find(&who->work, left, rig.left, left_part, step, in_left);
    const stereo_marker marker = stereo_match(rig, in_left, n_left, in_right, n_right, &i, &j);
    if (marker.reason == STEREO_SEEN) {
        who->left_blob = in_left[i];
        who->right_blob = in_right[j];
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
