#include "simrobot/world/visibility.h"

#include <algorithm>
#include <cmath>

namespace sim
{
namespace
{

/* The part of a line, as numbers 0 .. 1 along it, that is inside something. */
struct Span {
    double enter = 0, leave = 1;

    void cut(double low, double high)
    {
        enter = std::max(enter, low);
        leave = std::min(leave, high);
    }

    bool empty() const
    {
        return enter > leave;
    }
};

/* Cuts by |a + t b| <= limit, for one coordinate. */
void cut_slab(Span *span, double a, double b, double limit)
{
    if (b == 0) {
        if (std::fabs(a) > limit)
            span->cut(1, 0);
        return;
    }
    double first = (-limit - a) / b, second = (limit - a) / b;
    span->cut(std::min(first, second), std::max(first, second));
}

/* Cuts by |a + t b| <= radius, for vectors. */
template <typename Vector>
void cut_round(Span *span, const Vector &a, const Vector &b, double radius)
{
    double bb = b.squaredNorm(), ab = a.dot(b), c = a.squaredNorm() - radius * radius;
    double root = ab * ab - bb * c;

    if (bb == 0 || root < 0) {
        if (c > 0 || bb > 0)
            span->cut(1, 0);
        return;
    }
    root = std::sqrt(root);
    span->cut((-ab - root) / bb, (-ab + root) / bb);
}

bool meets_sphere(const Eigen::Vector3d &a, const Eigen::Vector3d &b, double radius)
{
    Span span;
    cut_round(&span, a, b, radius);
    return !span.empty();
}

bool meets_cylinder(const Eigen::Vector3d &a, const Eigen::Vector3d &b, double radius,
                    double length)
{
    Span span;
    cut_round(&span, Eigen::Vector2d(a.head<2>()), Eigen::Vector2d(b.head<2>()), radius);
    cut_slab(&span, a.z(), b.z(), length / 2);
    return !span.empty();
}

bool meets_box(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &edges)
{
    Span span;
    for (int i = 0; i < 3; i++)
        cut_slab(&span, a[i], b[i], edges[i] / 2);
    return !span.empty();
}

/* Whether the line meets a triangle (Moeller and Trumbore, 1997). */
bool meets_triangle(const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                    const Eigen::Vector3f *corner)
{
    Eigen::Vector3d origin = corner[0].cast<double>();
    Eigen::Vector3d u = corner[1].cast<double>() - origin, v = corner[2].cast<double>() - origin;
    Eigen::Vector3d across = b.cross(v), from = a - origin;
    double determinant = u.dot(across);

    if (determinant == 0)
        return false;
    double s = from.dot(across) / determinant;
    Eigen::Vector3d turned = from.cross(u);
    double t = b.dot(turned) / determinant, along = v.dot(turned) / determinant;
    return s >= 0 && t >= 0 && s + t <= 1 && along >= 0 && along <= 1;
}

bool meets_mesh(const Eigen::Vector3d &a, const Eigen::Vector3d &b, double radius,
                const Triangles &corners)
{
    if (!meets_sphere(a, b, radius))
        return false;
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
        if (meets_triangle(a, b, &corners[i]))
            return true;
    return false;
}

} // namespace

bool visibility_blocks(const Shape &shape, const Eigen::Vector3d &from, const Eigen::Vector3d &to)
{
    Eigen::Isometry3d inverse = shape.pose.inverse();
    Eigen::Vector3d a = inverse * from, b = inverse.linear() * (to - from);
    Eigen::Vector3d tip(0, 0, shape.size[1] / 2);

    switch (shape.kind) {
    case ShapeKind::sphere:
        return meets_sphere(a, b, shape.size[0]);
    case ShapeKind::box:
        return meets_box(a, b, shape.size);
    case ShapeKind::cylinder:
        return meets_cylinder(a, b, shape.size[0], shape.size[1]);
    case ShapeKind::mesh:
        return meets_mesh(a, b, shape.size[0], *shape.triangles);
    case ShapeKind::capsule:
        return meets_cylinder(a, b, shape.size[0], shape.size[1]) ||
               meets_sphere(a - tip, b, shape.size[0]) || meets_sphere(a + tip, b, shape.size[0]);
    }
    return false;
}

double visibility_of_ball(const std::vector<Shape> &shapes, const Eigen::Vector3d &eye,
                          const Eigen::Vector3d &ball, double radius)
{
    const int points = 60;
    const double golden_angle = 2.399963229728653;
    Eigen::Vector3d along = (ball - eye).normalized();
    Eigen::Vector3d x = along.unitOrthogonal(), y = along.cross(x);
    int seen = 0;

    /* A sunflower: points of equal share of the disc, just inside its rim, and on the side of the
     * ball that faces the eye, so that what holds the ball from behind does not hide it. */
    for (int i = 0; i < points; i++) {
        double r = 0.98 * radius * std::sqrt((i + 0.5) / points), angle = golden_angle * i;
        double depth = std::sqrt(radius * radius - r * r);
        Eigen::Vector3d point =
            ball + r * (std::cos(angle) * x + std::sin(angle) * y) - depth * along;
        seen += std::none_of(shapes.begin(), shapes.end(), [&](const Shape &shape) {
            return visibility_blocks(shape, eye, point);
        });
    }
    return static_cast<double>(seen) / points;
}

} // namespace sim
