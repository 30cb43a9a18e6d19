/* Pictures of a ball whose centre is known, drawn by casting rays: the truth that vision is
 * measured against. It shares nothing with vision/ but the definition of a camera. */
#ifndef TEST_SCENE_H
#define TEST_SCENE_H

#include <cstdint>
#include <random>
#include <vector>

#include "vision/ball/camera.h"
#include "vision/ball/image.h"

struct scene_sphere {
    direction centre; /* m, axes of the common frame between the eyes */
    double radius;    /* m */
    double colour[3]; /* 0 .. 1 */
};

struct scene {
    std::vector<scene_sphere> spheres; /* the nearest hit is seen */
    direction light;                   /* unit vector towards the lamp */
    double ambient = 0.35;             /* light that comes from everywhere */
    double gloss = 0.0;                /* strength of the highlight */
    double brightness = 1.0;
    double tint[3] = {1, 1, 1}; /* colour of the light */
    double noise = 2.0;         /* standard deviation, levels of 255 */
    double texture = 0.15;      /* contrast of the background, 0 .. 1 */
    bool bar = false;           /* an upright bar hides columns of the pictures */
    double bar_left = 0;        /* column, px, in both eyes */
    double bar_right = 0;
};

struct picture {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgb;
    image_view view() const;
};

/* Two cameras that turn inwards by half of `vergence` each, `baseline` apart. */
struct scene_eyes {
    camera left;
    camera right;
    double vergence; /* rad */
    double baseline; /* m */
};

scene_eyes scene_default_eyes();

/* The projection of a point of the common frame, relative to the image centre. */
void scene_project(const scene_eyes &eyes, bool left, const direction &point, double *u, double *v);

picture scene_draw(const scene &what, const scene_eyes &eyes, bool left, std::mt19937_64 &random);

/* A ball somewhere in view of both eyes, with random light and background. */
scene scene_random(std::mt19937_64 &random);

#endif
