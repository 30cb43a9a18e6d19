#include "simrobot/eyes/scene.h"

#include <algorithm>
#include <cmath>

#include "simrobot/setup/random.h"

namespace sim
{
namespace
{

const float table_height = -0.42f;

uint8_t byte_of(double value)
{
    return static_cast<uint8_t>(std::clamp(value, 0.0, 255.0));
}

void put(std::vector<uint8_t> *pixels, double red, double green, double blue)
{
    pixels->push_back(byte_of(red));
    pixels->push_back(byte_of(green));
    pixels->push_back(byte_of(blue));
}

void add(Corners *corners, ShapeKind kind, const Eigen::Vector3d &size,
         const Eigen::Vector3d &position, const Eigen::Vector3d &turn,
         const Eigen::Vector3f &colour)
{
    Eigen::Quaterniond rotation = Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX());
    mesh_append({kind, size, Eigen::Translation3d(position) * rotation, colour}, corners);
}

/* Long leaves that hang out of a pot, of a dull yellowish green. */
void add_plant(const Eigen::Vector3d &foot, Corners *corners)
{
    const int leaves = 11;

    add(corners, ShapeKind::cylinder, {0.055, 0.10, 0}, foot + Eigen::Vector3d(0, 0, 0.05),
        {0, 0, 0}, {0.60f, 0.30f, 0.20f});
    for (int i = 0; i < leaves; i++) {
        double turn = 2.4 * i, tilt = 0.25 + 0.09 * i;
        Eigen::Vector3d out(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                            std::cos(tilt));
        float shade = 0.85f + 0.03f * static_cast<float>(i % 5);
        add(corners, ShapeKind::capsule, {0.011, 0.15, 0},
            foot + Eigen::Vector3d(0, 0, 0.10) + 0.08 * out, {0, tilt, turn},
            shade * Eigen::Vector3f(0.32f, 0.42f, 0.20f));
    }
}

} // namespace

std::vector<uint8_t> scene_wood(int size)
{
    std::vector<uint8_t> pixels;
    Random random(1, 10);
    std::vector<double> grain(static_cast<size_t>(size));
    const double full_turn = 6.283185307179586;

    for (double &g : grain)
        g = random.uniform(-1, 1);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            double u = static_cast<double>(x) / size, v = static_cast<double>(y) / size;
            double wave = std::sin(full_turn * (9 * v + 0.35 * std::sin(full_turn * u)));
            bool joint = y % (size / 4) < size / 128 + 1;
            double shade = 150 + 14 * wave + 9 * grain[static_cast<size_t>(y)] +
                           5 * random.uniform(-1, 1) - (joint ? 45 : 0);
            put(&pixels, shade * 1.08, shade * 0.83, shade * 0.60);
        }
    return pixels;
}

std::vector<uint8_t> scene_wallpaper(int size)
{
    std::vector<uint8_t> pixels;
    Random random(1, 11);

    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            bool stripe = (x / (size / 8)) % 2;
            int cx = x % (size / 4) - size / 8, cy = y % (size / 4) - size / 8;
            bool dot = cx * cx + cy * cy < size * size / 1200;
            double shade = 196 + (stripe ? 9 : 0) - (dot ? 34 : 0) + 6 * random.uniform(-1, 1);
            put(&pixels, shade, shade * 0.98, shade * (dot ? 1.06 : 0.93));
        }
    return pixels;
}

Corners scene_table()
{
    Corners corners;
    mesh_append_rectangle({0.25f, -1.2f, table_height}, {1.35f, 0, 0}, {0, 2.4f, 0},
                          {1.0f, 1.0f, 1.0f}, 3, &corners);
    return corners;
}

Corners scene_walls()
{
    Corners corners;
    const Eigen::Vector3f paint(0.95f, 0.95f, 0.95f), floor(0.45f, 0.43f, 0.42f);
    const float height = 2.6f, bottom = -1.2f;

    mesh_append_rectangle({2.6f, 3.0f, bottom}, {0, -6.0f, 0}, {0, 0, height}, paint, 5, &corners);
    mesh_append_rectangle({-1.0f, 3.0f, bottom}, {3.6f, 0, 0}, {0, 0, height}, paint, 4, &corners);
    mesh_append_rectangle({2.6f, -3.0f, bottom}, {-3.6f, 0, 0}, {0, 0, height}, paint, 4, &corners);
    mesh_append_rectangle({-1.0f, -3.0f, bottom}, {3.6f, 0, 0}, {0, 6.0f, 0}, floor, 6, &corners);
    return corners;
}

Corners scene_things()
{
    Corners corners;
    const double z = table_height;

    add_plant({1.20, 0.38, z}, &corners);
    add(&corners, ShapeKind::cylinder, {0.042, 0.10, 0}, {0.98, -0.62, z + 0.05}, {0, 0, 0},
        {0.25f, 0.38f, 0.66f});
    add(&corners, ShapeKind::box, {0.24, 0.17, 0.035}, {1.12, -0.22, z + 0.018}, {0, 0, 0.4},
        {0.62f, 0.22f, 0.20f});
    add(&corners, ShapeKind::box, {0.21, 0.15, 0.028}, {1.11, -0.21, z + 0.049}, {0, 0, 0.75},
        {0.83f, 0.72f, 0.36f});
    add(&corners, ShapeKind::box, {0.28, 0.20, 0.012}, {0.86, 0.12, z + 0.006}, {0, 0, -0.3},
        {0.86f, 0.86f, 0.84f});
    /* A poster low on the wall behind the table, a pale bluish green. */
    add(&corners, ShapeKind::box, {0.01, 0.70, 0.50}, {2.58, -0.55, -0.35}, {0, 0, 0},
        {0.46f, 0.66f, 0.56f});
    add(&corners, ShapeKind::box, {0.012, 0.50, 0.10}, {2.575, -0.55, -0.25}, {0, 0, 0},
        {0.85f, 0.84f, 0.72f});
    return corners;
}

} // namespace sim
