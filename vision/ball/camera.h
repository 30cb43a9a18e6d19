/* One eye's optics: pixels to viewing directions and back, by OpenCV's model of a camera.
 *
 * Axes of an eye: x to the right, y down, z along the optical axis. A pixel (column, row) names the
 * pixel's centre, so the centre of a picture 640 pixels wide is column 319.5. */
#ifndef VISION_BALL_CAMERA_H
#define VISION_BALL_CAMERA_H

struct camera {
    int width;       /* px */
    int height;      /* px */
    double focal;    /* px, along a row: OpenCV's fx */
    double centre_u; /* principal point to the right of the image centre; px */
    double centre_v; /* principal point below the image centre; px */
    double k1;       /* OpenCV's model of distortion: radial, of (r / focal)^2 */
    double k2;       /* radial, of (r / focal)^4 */
    double k3 = 0;   /* radial, of (r / focal)^6 */
    double p1 = 0;   /* tangential */
    double p2 = 0;
    double aspect = 1; /* OpenCV's fy / fx */
    double yaw = 0;    /* how the camera is turned beside its place in the rig, see stereo.h; rad */
    double pitch = 0;
    double roll = 0;
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

/* A direction of the camera's own axes in those of the rig's ideal camera, from which the camera is
 * turned by its roll (clockwise, as it looks), pitch (downwards) and yaw (to the right). */
direction camera_upright(const camera &eye, const direction &view);

#endif
