/* What pictures say of a ball of about a colour: where it is, and which colours its pixels have. */
#ifndef VISION_COLOUR_EVIDENCE_H
#define VISION_COLOUR_EVIDENCE_H

#include <opencv2/core.hpp>

#include <vector>

#include "vision/ball/segment.h"

/* A picture in which the ball was found. */
struct colour_sighting {
    size_t picture;
    blob ball;
};

/* Looks for a ball of the range in all pictures. Of several in a picture the one that moves most is
 * taken, and where there are several pictures one that never moves is none at all. */
std::vector<colour_sighting> evidence_follow(const std::vector<cv::Mat> &pictures,
                                             const colour_range &range);

/* How much the sightings are those of a ball, for comparing seeds. */
double evidence_weight(const std::vector<colour_sighting> &sightings);

/* Whether a sighting in this picture holds the point. */
bool evidence_holds(const std::vector<colour_sighting> &sightings, size_t picture,
                    const pixel_point &at);

/* Adds the sightings' pixels, as far as they have a colour. */
void evidence_pixels(const std::vector<cv::Mat> &pictures,
                     const std::vector<colour_sighting> &sightings,
                     std::vector<colour_hsv> *pixels);

/* The range of these pixels, with margins: all but the palest, the darkest and the most different,
 * of which glints and prints are made. Returns false where there are too few. */
bool evidence_range(const std::vector<colour_hsv> &pixels, colour_range *range);

/* Share of the pixels beside the ball, in pictures where it was found, that the range takes. */
double evidence_clutter(const std::vector<cv::Mat> &pictures,
                        const std::vector<colour_sighting> &sightings, const colour_range &range);

#endif
