/* A ball drawn by casting rays, with prints, glints and shading that turn with its surface. */
#ifndef REACH_TOOLS_PICTURES_BALL_H
#define REACH_TOOLS_PICTURES_BALL_H

#include <opencv2/core.hpp>

#include <random>
#include <vector>

#include "vision/ball/camera.h"

using random_source = std::mt19937_64;

/* Evenly distributed; the same on every machine, which std::uniform_real_distribution is not. */
double random_between(random_source *random, double low, double high);
int random_whole(random_source *random, int n); /* 0 .. n - 1 */

/* A print on the surface: where `low` < normal . towards < high, and normal . side > side_min. */
struct print {
    direction towards;
    double low;
    double high;
    direction side;
    double side_min;
    cv::Vec3f colour; /* BGR, 0 .. 1 */
};

/* What shines in the surface as white as the lamp: normal . towards to this power. */
struct glint {
    direction towards;
    double power;
    double strength; /* 1 and more over-expose */
};

struct drawn_ball {
    pixel_point centre; /* image of its centre; px */
    double radius;      /* focal length times the tangent of half its angle of view; px */
    cv::Vec3f colour;   /* BGR, 0 .. 1 */
    direction light;    /* unit vector, eye's axes */
    double ambient;
    double exposure; /* 1: nothing is clipped */
    std::vector<print> prints;
    std::vector<glint> glints;
};

/* A ball of some colour and light, no prints. */
drawn_ball ball_plain(random_source *random, const cv::Vec3f &colour);

/* A line, letters or panels, over a quarter of the surface at most. */
void ball_add_prints(random_source *random, drawn_ball *ball);

/* Small lamps in it, as in a shiny one. */
void ball_add_glints(random_source *random, drawn_ball *ball);

/* Draws it over the picture (CV_32FC3, BGR, 0 .. 1 and more where over-exposed). */
void ball_draw(const drawn_ball &ball, const camera &eye, cv::Mat *picture);

#endif
