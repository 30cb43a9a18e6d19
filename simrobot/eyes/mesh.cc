#include "simrobot/eyes/mesh.h"

#include <algorithm>
#include <cmath>

namespace sim
{
namespace
{

const double half_turn = 3.14159265358979323846;

/* A round body as rings of points: a profile (radius, height, slope) turned about z. */
struct Ring {
    double radius, height;
    double normal_out, normal_up; /* of the surface, outwards and along z */
};

class Writer
{
public:
    Writer(const Shape &shape, Corners *corners)
        : pose_(shape.pose.cast<float>()), colour_(shape.colour), corners_(corners)
    {
    }

    void turn(const std::vector<Ring> &rings, int sides)
    {
        for (size_t i = 0; i + 1 < rings.size(); i++)
            for (int s = 0; s < sides; s++)
                band(rings[i], rings[i + 1], 2 * half_turn * s / sides,
                     2 * half_turn * (s + 1) / sides);
    }

    void box(const Eigen::Vector3d &edges)
    {
        for (int axis = 0; axis < 3; axis++)
            for (double side : {-0.5, 0.5}) {
                Eigen::Vector3d out = Eigen::Vector3d::Zero(), u = out, v = out;
                out[axis] = side * 2;
                u[(axis + 1) % 3] = edges[(axis + 1) % 3] / 2 * side * 2;
                v[(axis + 2) % 3] = edges[(axis + 2) % 3] / 2;
                Eigen::Vector3d middle = out * edges[axis] / 2;
                triangle(middle - u - v, middle + u - v, middle + u + v, out, out, out);
                triangle(middle - u - v, middle + u + v, middle - u + v, out, out, out);
            }
    }

    void triangles(const Triangles &corners)
    {
        for (size_t i = 0; i + 2 < corners.size(); i += 3) {
            Eigen::Vector3d a = corners[i].cast<double>(), b = corners[i + 1].cast<double>(),
                            c = corners[i + 2].cast<double>();
            Eigen::Vector3d out = (b - a).cross(c - a).normalized();
            triangle(a, b, c, out, out, out);
        }
    }

private:
    void band(const Ring &low, const Ring &high, double from, double to)
    {
        Eigen::Vector3d a = at(low, from), b = at(low, to), c = at(high, to), d = at(high, from);
        Eigen::Vector3d na = out(low, from), nb = out(low, to), nc = out(high, to),
                        nd = out(high, from);
        if (low.radius > 0)
            triangle(a, b, c, na, nb, nc);
        if (high.radius > 0)
            triangle(a, c, d, na, nc, nd);
    }

    static Eigen::Vector3d at(const Ring &ring, double angle)
    {
        return {ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.height};
    }

    static Eigen::Vector3d out(const Ring &ring, double angle)
    {
        return {ring.normal_out * std::cos(angle), ring.normal_out * std::sin(angle),
                ring.normal_up};
    }

    void triangle(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c,
                  const Eigen::Vector3d &na, const Eigen::Vector3d &nb, const Eigen::Vector3d &nc)
    {
        put(a, na);
        put(b, nb);
        put(c, nc);
    }

    void put(const Eigen::Vector3d &point, const Eigen::Vector3d &normal)
    {
        corners_->push_back({pose_ * point.cast<float>(), pose_.linear() * normal.cast<float>(),
                             colour_, Eigen::Vector2f::Zero()});
    }

    Eigen::Isometry3f pose_;
    Eigen::Vector3f colour_;
    Corners *corners_;
};

std::vector<Ring> sphere_rings(double radius, int n)
{
    std::vector<Ring> rings;
    for (int i = 0; i <= n; i++) {
        double angle = half_turn * (static_cast<double>(i) / n - 0.5);
        double flat = i == 0 || i == n ? 0 : std::cos(angle);
        rings.push_back({radius * flat, radius * std::sin(angle), flat, std::sin(angle)});
    }
    return rings;
}

/* Flat caps have normals of their own, hence the doubled rings. */
std::vector<Ring> cylinder_rings(double radius, double length)
{
    double h = length / 2;
    return {{0, -h, 0, -1},    {radius, -h, 0, -1}, {radius, -h, 1, 0},
            {radius, h, 1, 0}, {radius, h, 0, 1},   {0, h, 0, 1}};
}

std::vector<Ring> capsule_rings(double radius, double length)
{
    double h = length / 2, s = std::sqrt(0.5);
    return {{0, -h - radius, 0, -1}, {radius * s, -h - radius * s, s, -s}, {radius, -h, 1, 0},
            {radius, h, 1, 0},       {radius * s, h + radius * s, s, s},   {0, h + radius, 0, 1}};
}

bool is_shown(const Corner *corner, const View &view)
{
    Eigen::Vector3f a = corner[0].position - view.eye, b = corner[1].position - view.eye,
                    c = corner[2].position - view.eye;

    if ((b - a).cross(c - a).dot(a) >= 0)
        return false;
    for (const Eigen::Vector3f &inwards : view.inwards)
        if (inwards.dot(a) < 0 && inwards.dot(b) < 0 && inwards.dot(c) < 0)
            return false;
    return true;
}

uint8_t byte_of(float value)
{
    return static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

/* Lambert's law for the lamp; from all sides, more from above than from below. */
Vertex lit(const Corner &corner, const LightState &light)
{
    float lamp = std::max(0.0f, corner.normal.dot(light.direction));
    float sky = 0.75f + 0.25f * corner.normal.z();
    Eigen::Vector3f colour = corner.colour.cwiseProduct(light.colour * lamp + light.ambient * sky);

    return {{corner.position.x(), corner.position.y(), corner.position.z()},
            {byte_of(colour.x()), byte_of(colour.y()), byte_of(colour.z()), 255},
            {corner.texture.x(), corner.texture.y()}};
}

} // namespace

void mesh_append(const Shape &shape, Corners *corners)
{
    Writer writer(shape, corners);

    switch (shape.kind) {
    case ShapeKind::sphere:
        return writer.turn(sphere_rings(shape.size[0], 10), 16);
    case ShapeKind::cylinder:
        return writer.turn(cylinder_rings(shape.size[0], shape.size[1]), 20);
    case ShapeKind::capsule:
        return writer.turn(capsule_rings(shape.size[0], shape.size[1]), 10);
    case ShapeKind::box:
        return writer.box(shape.size);
    case ShapeKind::mesh:
        return writer.triangles(*shape.triangles);
    }
}

void mesh_append_rectangle(const Eigen::Vector3f &corner, const Eigen::Vector3f &edge_u,
                           const Eigen::Vector3f &edge_v, const Eigen::Vector3f &colour,
                           float repeat, Corners *corners)
{
    const float around[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    Eigen::Vector3f normal = edge_u.cross(edge_v).normalized();

    for (const float *at : around)
        corners->push_back({corner + at[0] * edge_u + at[1] * edge_v, normal, colour,
                            Eigen::Vector2f(at[0], at[1]) * repeat});
}

void mesh_show(const Corners &corners, const LightState &light, const View &view,
               std::vector<Vertex> *vertices)
{
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
        if (!is_shown(&corners[i], view))
            continue;
        for (size_t k = i; k < i + 3; k++)
            vertices->push_back(lit(corners[k], light));
    }
}

} // namespace sim
