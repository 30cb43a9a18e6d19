/* A printed square tag, ArUco's or AprilTag's (OpenCV's aruco module), in the ball's place. */
#ifndef VISION_BALL_TAG_H
#define VISION_BALL_TAG_H

#include <opencv2/aruco.hpp>

#include "vision/ball/segment.h"

/* The dictionaries in OpenCV's order, as words of an option; the first word is for none of them. */
#define TAG_DICTIONARIES                                                                           \
    "none|4x4_50|4x4_100|4x4_250|4x4_1000|5x5_50|5x5_100|5x5_250|5x5_1000|6x6_50|6x6_100|6x6_250|" \
    "6x6_1000|7x7_50|7x7_100|7x7_250|7x7_1000|original|apriltag_16h5|apriltag_25h9|"               \
    "apriltag_36h10|apriltag_36h11"

struct tag_config {
    int dictionary = 0; /* index in TAG_DICTIONARIES; 0: a ball is sought, not a tag */
    int id = 0;
};

/* Kept between pictures. */
struct tag_finder {
    tag_config config;
    cv::Ptr<cv::aruco::Dictionary> dictionary; /* empty when a ball is sought */
    cv::Ptr<cv::aruco::DetectorParameters> parameters;
    cv::Mat grey;
};

/* How many tags the dictionary has. */
int tag_count(int dictionary);

tag_finder tag_finder_create(const tag_config &config);

/* Looks for the tag in a region. A blob of it has the tag's centre (where its diagonals cross, at
 * whatever slant it is seen) as axis, and the cone of a ball about that, whose diameter is the
 * tag's side: so it passes the checks of a ball. Writes up to SEGMENT_CANDIDATES blobs, the largest
 * first, and, into `refused` (SEGMENT_REFUSED) and `n_refused`, tags of other numbers; returns how
 * many blobs. */
int tag_find(tag_finder *finder, const image_view &image, const camera &eye,
             const image_region &region, blob *blobs, refused_blob *refused, int *n_refused);

/* The tag with a white margin, for printing; `side` px along the tag. Grey, 8 bit. */
cv::Mat tag_picture(const tag_config &config, int side);

#endif
