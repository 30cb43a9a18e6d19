/* Where the ball ends, to a fraction of a pixel, along rays from its middle. */
#ifndef VISION_BALL_EDGES_H
#define VISION_BALL_EDGES_H

#include "vision/ball/camera.h"
#include "vision/ball/colour.h"
#include "vision/ball/image.h"
#include "vision/ball/outline.h"

/* To the pixel: from `start` outwards, the last pixel of the ball's colour before others begin,
 * no further than `reach` px. Rays that meet no end inside the picture stay invalid. */
void edges_coarse(const image_view &image, const colour_table &colours, const camera &eye,
                  const pixel_point &start, double reach, outline_points *points);

/* To a fraction of a pixel, close to an outline that is known to about 2 px. Rays on which the
 * inner side has not the ball's colour (something stands in front), or both sides look alike, stay
 * invalid. */
void edges_fine(const image_view &image, const colour_table &colours, const camera &eye,
                const outline &guess, outline_points *points);

#endif
