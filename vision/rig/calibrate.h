/* Learns how the eyes stand from a ball that is moved about before them. */
#ifndef VISION_RIG_CALIBRATE_H
#define VISION_RIG_CALIBRATE_H

#include <opencv2/core.hpp>

#include "vision/ball/eyes.h"
#include "vision/pictures/decode.h"
#include "vision/pictures/source.h"
#include "vision/rig/solve.h"

class rig_calibrator : public pair_receiver
{
public:
    explicit rig_calibrator(const eyes_config &config);

    void take(const incoming_pair &pair) override;
    void refuse(const char *reason) override;

    /* Whether pairs of enough time have come. */
    bool done() const;

    /* Solves, says on the log what came out, and writes the rig into the file, and, with `drawing`,
     * a picture of both eyes' views with the sightings in it.
     *   returns 0, or -1 after one line in the log. */
    int finish(const char *path, const char *drawing);

private:
    void settle_aspect();
    bool find(const image_view &image, const camera &eye, blob *found);

    eyes_config config_;
    segmenter work_;
    decoder left_;
    decoder right_;
    std::vector<sighting> sightings_;
    pixel_point newest_ = {0, 0}; /* where the right eye last saw the ball for a sighting; px */
    int64_t first_utime_ = 0;
    int64_t utime_ = 0;
    int64_t told_ = 0;
    bool settled_ = false; /* the aspect with which the sightings were found is right */
    int pairs_ = 0;
    int refused_ = 0;
};

#endif
