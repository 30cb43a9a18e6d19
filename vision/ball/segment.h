/* One eye's picture: which things in it could be the ball, and where exactly. */
#ifndef VISION_BALL_SEGMENT_H
#define VISION_BALL_SEGMENT_H

#include "vision/ball/camera.h"
#include "vision/ball/colour.h"
#include "vision/ball/image.h"
#include "vision/ball/mask.h"
#include "vision/ball/outline.h"

enum { SEGMENT_CANDIDATES = 4, SEGMENT_REFUSED = 8 };

struct segment_limits {
    double radius_min;   /* apparent radius, half the angle of view; rad */
    double radius_max;   /* rad */
    double coverage_min; /* share of the outline that must be seen, 0 .. 1 */
    double fill_min;     /* share of the disc that must have the ball's colour, 0 .. 1 */
    double roughness;    /* largest rms distance of the seen edge from the outline; px */
};

/* Why a thing of the ball's colour is not the ball. */
enum blob_fault {
    BLOB_GOOD = 0,
    BLOB_NO_OUTLINE, /* no circle fits its edge */
    BLOB_TOO_SMALL,
    BLOB_TOO_LARGE,
    BLOB_COVERAGE, /* too little of the outline is seen */
    BLOB_FILL,     /* too little of the disc has the colour */
    BLOB_ROUGH,
    BLOB_LEAKS,     /* its colour goes on beyond the outline */
    BLOB_NO_TAG,    /* where a tag is sought: there is none */
    BLOB_OTHER_TAG, /* it has another number */
    BLOB_FAULTS,
};

/* A thing that may be the ball. */
struct blob {
    outline cone;      /* where it is, and how large */
    pixel_point pixel; /* image of its centre; px */
    double radius;     /* apparent radius, focal length times tan(half angle); px */
    double coverage;   /* share of the outline inside the picture that is seen, 0 .. 1 */
    double fill;       /* share of the disc that has the ball's colour, 0 .. 1 */
    double leak;       /* share of the outline beyond which the colour goes on, 0 .. 1 */
    double score;      /* how much it is like the ball; grows with its radius */
};

/* A thing that was not taken, where it was and how large; px. */
struct refused_blob {
    blob_fault fault;
    pixel_point pixel;
    double radius;
};

struct segmenter {
    colour_range range;
    colour_table colours;
    segment_limits limits;
    mask_work mask;
    refused_blob refused[SEGMENT_REFUSED]; /* by the newest segment_find, the largest first */
    int n_refused;
};

/* What a person is told of it: "too little of its outline is seen". */
const char *blob_fault_text(blob_fault fault);

/* Looks in the region at every `step`-th pixel of every `step`-th row, then closely at what it
 * found. Writes up to SEGMENT_CANDIDATES blobs, the most ball-like first; returns how many. */
int segment_find(segmenter *work, const image_view &image, const camera &eye,
                 const image_region &region, int step, blob *blobs);

#endif
