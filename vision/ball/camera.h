/* One eye's optics: pixels to viewing directions and back.
 *
 * Axes of an eye: x to the right, y down, z along the optical axis. A pixel (column, row) names the
 * pixel's centre, so the centre of a picture 640 pixels wide is column 319.5. */
#ifndef VISION_BALL_CAMERA_H
#define VISION_BALL_CAMERA_H

struct camera {
    int width;       /* px */
    int height;      /* px */
    double focal;    /* px */
    double centre_u; /* principal point to the right of the image centre; px */
    double centre_v; /* principal point below the image centre; px */
    double k1;       /* radial distortion, of (r / focal)^2 */
    double k2;       /* radial distortion, of (r / focal)^4 */
};

struct direction {
    double x;
    double y;
    double z;
};

/* Column and row, px. */
struct pixel_point {
    double column;
    double row;
};

inline double direction_dot(const direction &a, const direction &b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

direction direction_cross(const direction &a, const direction &b);

/* Unit vector along `a`. */
direction direction_normalised(const direction &a);

/* The unit viewing direction of a pixel. Distortion is undone by a fixed number of steps. */
direction camera_direction(const camera &eye, const pixel_point &pixel);

/* Where a direction (z > 0) falls on the sensor, distortion included. */
pixel_point camera_project(const camera &eye, const direction &view);

#endif
