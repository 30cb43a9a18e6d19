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
    return 1 + squared * (eye.k1 + squared * (eye.k2 + squared * eye.k3));
}

/* By how much a lens that is not parallel to the sensor shifts, in slopes. */
static pixel_point shift(const camera &eye, double x, double y)
{
    const double squared = x * x + y * y;

    return {2 * eye.p1 * x * y + eye.p2 * (squared + 2 * x * x),
            eye.p1 * (squared + 2 * y * y) + 2 * eye.p2 * x * y};
}

direction camera_direction(const camera &eye, const pixel_point &pixel)
{
    const double distorted_x = (pixel.column - (eye.width - 1) / 2.0 - eye.centre_u) / eye.focal;
    const double distorted_y =
        (pixel.row - (eye.height - 1) / 2.0 - eye.centre_v) / (eye.focal * eye.aspect);
    double x = distorted_x;
    double y = distorted_y;

    if (eye.k1 != 0 || eye.k2 != 0 || eye.k3 != 0 || eye.p1 != 0 || eye.p2 != 0)
        for (int i = 0; i < undistort_steps; i++) {
            const double factor = stretch(eye, x * x + y * y);
            const pixel_point aside = shift(eye, x, y);
            x = (distorted_x - aside.column) / factor;
            y = (distorted_y - aside.row) / factor;
        }
    return direction_normalised({x, y, 1});
}

pixel_point camera_project(const camera &eye, const direction &view)
{
    const double x = view.x / view.z;
    const double y = view.y / view.z;
    const double scale = eye.focal * stretch(eye, x * x + y * y);
    const pixel_point aside = shift(eye, x, y);

    return {x * scale + aside.column * eye.focal + (eye.width - 1) / 2.0 + eye.centre_u,
            (y * scale + aside.row * eye.focal) * eye.aspect + (eye.height - 1) / 2.0 +
                eye.centre_v};
}

direction camera_upright(const camera &eye, const direction &view)
{
    const double cy = std::cos(eye.yaw), sy = std::sin(eye.yaw);
    const double cp = std::cos(eye.pitch), sp = std::sin(eye.pitch);
    const double cr = std::cos(eye.roll), sr = std::sin(eye.roll);
    const direction rolled = {cr * view.x - sr * view.y, sr * view.x + cr * view.y, view.z};
    const direction pitched = {rolled.x, cp * rolled.y + sp * rolled.z,
                               cp * rolled.z - sp * rolled.y};

    return {cy * pitched.x + sy * pitched.z, pitched.y, cy * pitched.z - sy * pitched.x};
}
