/* The seeing: two pictures in, one marker out, and the memory of where the ball was between them.
 *
 * What is said depends on nothing but the pictures and stamps so far. */
#ifndef VISION_BALL_EYES_H
#define VISION_BALL_EYES_H

#include <cstdint>

#include "vision/ball/segment.h"
#include "vision/ball/stereo.h"
#include "vision/ball/tag.h"
#include "vision/ball/track.h"

struct eyes_config {
    colour_range colour;
    tag_config tag; /* sought instead of the ball where it has a dictionary */
    segment_limits limits;
    stereo_rig rig;
    track_window window;
    int window_step;    /* px between the pixels looked at in a window */
    int whole_step;     /* px between the pixels looked at in whole pictures */
    int64_t most_apart; /* between the eyes' own stamps, 0 = not checked; us */
    int recheck;        /* after this many pairs in windows the whole pictures are looked at once */
};

/* What an eye saw at the newest look. Nothing of the left one when the right saw no ball. */
struct eye_findings {
    blob found[SEGMENT_CANDIDATES]; /* the most ball-like first */
    int n_found;
    refused_blob refused[SEGMENT_REFUSED]; /* the largest first */
    int n_refused;
};

struct eyes {
    eyes_config config;
    segmenter work;
    tag_finder tags;
    track left;
    track right;
    int64_t newest;   /* newest stamp so far, 0 = none; us */
    int in_windows;   /* pairs since whole pictures were looked at */
    bool used_window; /* the newest look was settled in windows */
    eye_findings in_left;
    eye_findings in_right;
    blob left_blob; /* what the newest marker was made of, where it was seen */
    blob right_blob;
};

void eyes_init(eyes *who, const eyes_config &config);

/* Looks at a pair exposed at `utime` (us, > 0). First around where the ball is expected; when that
 * fails, in the whole pictures.
 *
 * A pair older than the newest (a repetition of one that was lost) is answered from whole pictures
 * and leaves the memory alone; when it is more than a second older, the clock was set back and
 * everything is forgotten. */
stereo_marker eyes_look(eyes *who, int64_t utime, const image_view &left, const image_view &right);

#endif
