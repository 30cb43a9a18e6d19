/* How much a found outline is that of the ball. */
#ifndef VISION_BALL_JUDGE_H
#define VISION_BALL_JUDGE_H

#include "vision/ball/segment.h"

/* The apparent radii that a ball may have in a picture; px. */
struct radius_range {
    double least;
    double most;
};
radius_range judge_radii(const segment_limits &limits, const camera &eye);

/* Fills in what `found` lacks besides its cone, of which `points` are the edges, and holds it
 * against the limits. Returns BLOB_GOOD or the first fault. */
blob_fault judge_blob(const segmenter &work, const image_view &image, const camera &eye,
                      const outline_points &points, blob *found);

/* Whether it could be a ball that shows not quite round: much of its outline is seen, not exactly.
 */
bool judge_stretched(const segmenter &work, const blob &found);

/* Whether nothing about it is in doubt: no other look could find a better one here. */
bool judge_clear(const blob &found);

#endif
