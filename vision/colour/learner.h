/* Learns which colour the ball has: from a point on it, or from what is round and moves. */
#ifndef VISION_COLOUR_LEARNER_H
#define VISION_COLOUR_LEARNER_H

#include <opencv2/core.hpp>

#include <cstdio>
#include <vector>

#include "vision/colour/evidence.h"
#include "vision/pictures/decode.h"
#include "vision/pictures/source.h"

class colour_learner : public pair_receiver
{
public:
    void take(const incoming_pair &pair) override;
    void refuse(const char *reason) override;

    /* Says that the ball is at this pixel of newest(), or of the first picture that comes. */
    void point(const pixel_point &at);

    bool pointed() const
    {
        return has_point_;
    }

    /* Whether pictures of enough time have come since the beginning, or since a point was given. */
    bool done() const;

    /* The newest picture, right eye, BGR, made smaller where it is large; empty before the first.
     */
    const cv::Mat &newest() const;

    /* Writes the colour as YAML, and, with `drawing`, the last picture with the ball and what has
     * its colour. returns 0, or -1 after one line in the log. */
    int finish(FILE *out, const char *drawing);

private:
    void keep(decoder *eye, const encoded_image &image, std::vector<cv::Mat> *pictures);
    bool learn(const std::vector<colour_sighting> &sightings, colour_range *range) const;
    bool follow(std::vector<colour_sighting> *sightings) const;
    bool follow_point(std::vector<colour_sighting> *sightings) const;

    decoder left_;
    decoder right_;
    std::vector<cv::Mat> pictures_;  /* of the right eye, BGR */
    std::vector<cv::Mat> left_ones_; /* of the left one, where it is another */
    pixel_point point_ = {0, 0};
    size_t pointed_ = 0; /* the picture that point_ is in */
    bool has_point_ = false;
    int64_t since_ = 0; /* utime of the first picture that counts; us */
    int64_t utime_ = 0;
    int64_t kept_ = 0; /* utime of the newest that was kept */
    int refused_ = 0;
};

#endif
