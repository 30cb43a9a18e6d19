/* Where the ball ends, to a fraction of a pixel, along rays from its middle. */
#ifndef VISION_BALL_EDGES_H
#define VISION_BALL_EDGES_H

#include "vision/ball/camera.h"
#include "vision/ball/colour.h"
#include "vision/ball/image.h"
#include "vision/ball/outline.h"

/* Unit vector of a ray, columns to the right, rows downwards. */
pixel_point edges_ray(int i);

/* To the pixel: from `start` outwards, the last pixel of the ball's colour before others begin,
 * no further than `reach` px. Rays that meet no end inside the picture stay invalid. */
void edges_coarse(const image_view &image, const colour_table &colours, const camera &eye,
                  const pixel_point &start, double reach, outline_points *points);

/* All that could be the outline on rays from one point: each place where the ball's colour ends for
 * some pixels, by ray. */
enum { EDGES_ENDS = 5 }; /* a ray; later ones replace the last */
struct outline_ends {
    direction view[OUTLINE_RAYS * EDGES_ENDS];
    int first[OUTLINE_RAYS + 1]; /* of each ray; then how many there are */
};

/* As edges_coarse, but each ray goes on behind the first end, until it leaves the picture or meets
 * none of the ball's colour for `pause` px. */
void edges_all(const image_view &image, const colour_table &colours, const camera &eye,
               const pixel_point &start, double reach, double pause, outline_ends *ends);

/* To a fraction of a pixel, close to an outline that is known to about 2 px. Rays on which the
 * inner side has not the ball's colour (something stands in front), or both sides look alike, stay
 * invalid. */
void edges_fine(const image_view &image, const colour_table &colours, const camera &eye,
                const outline &guess, outline_points *points);

#endif
