#include "vision/ball/camera.h"

#include <cmath>

static const int undistort_steps = 8;

direction direction_cross(const direction &a, const direction &b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

direction direction_normalised(const direction &a)
{
    const double scale = 1 / std::sqrt(direction_dot(a, a));

    return {a.x * scale, a.y * scale, a.z * scale};
}

/* How much a lens with radial distortion stretches at the undistorted squared radius. */
static double stretch(const camera &eye, double squared)
{
    return 1 + squared * (eye.k1 + squared * eye.k2);
}

direction camera_direction(const camera &eye, const pixel_point &pixel)
{
    const double distorted_x = (pixel.column - (eye.width - 1) / 2.0 - eye.centre_u) / eye.focal;
    const double distorted_y = (pixel.row - (eye.height - 1) / 2.0 - eye.centre_v) / eye.focal;
    double x = distorted_x;
    double y = distorted_y;

    if (eye.k1 != 0 || eye.k2 != 0)
        for (int i = 0; i < undistort_steps; i++) {
            const double factor = stretch(eye, x * x + y * y);
            x = distorted_x / factor;
            y = distorted_y / factor;
        }
    return direction_normalised({x, y, 1});
}

pixel_point camera_project(const camera &eye, const direction &view)
{
    const double x = view.x / view.z;
    const double y = view.y / view.z;
    const double scale = eye.focal * stretch(eye, x * x + y * y);

    return {x * scale + (eye.width - 1) / 2.0 + eye.centre_u,
            y * scale + (eye.height - 1) / 2.0 + eye.centre_v};
}
